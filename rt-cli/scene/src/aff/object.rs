//! The statements of AFF that stand for things.

use glam::Vec3;

use super::file::{Checked, File};
use super::keys::{Keys, MovingTriangle};
use super::read::Reader;
use super::surface::material;
use crate::model::{Cone, Light, Sphere, Triangle, View};
use crate::text::{Word, decode};

impl Reader<'_, '_> {
    pub(super) fn view(&mut self, file: &mut File<'_>, keyword: Word<'_>) -> Checked {
        let (mut eye, mut target, mut up, mut fov_y, mut size) = (None, None, None, None, None);
        loop {
            if file.take(b"from") {
                eye = Some(file.vector("from")?);
            } else if file.take(b"at") {
                target = Some(file.vector("at")?);
            } else if file.take(b"up") {
                up = Some(file.vector("up")?);
            } else if file.take(b"angle") {
                let [angle] = file.numbers("angle")?;
                if !(angle > 0.0 && angle < 180.0) {
                    let message =
                        format!("expected an angle between 0 and 180 degrees, found {angle}");
                    return Err(file.error(keyword.at, message));
                }
                fov_y = Some(angle);
            } else if file.take(b"hither") {
                file.numbers::<1>("hither")?;
            } else if file.take(b"resolution") {
                let side = |file: &mut File<'_>| file.integer(1..=1 << 16, "1 to 65536 pixels");
                size = Some((side(file)? as u32, side(file)? as u32));
            } else {
                break;
            }
        }
        let missing = |name| file.error(keyword.at, format!("expected '{name}' after 'v'"));
        self.scene.view = Some(View {
            eye: eye.ok_or_else(|| missing("from"))?,
            target: target.ok_or_else(|| missing("at"))?,
            up: up.ok_or_else(|| missing("up"))?,
            fov_y: fov_y.ok_or_else(|| missing("angle"))?,
            size,
        });
        Ok(())
    }

    pub(super) fn light(&mut self, file: &mut File<'_>, keyword: &str) -> Checked {
        let position = file.vector(keyword)?;
        let color = match file.has_number() {
            true => file.vector(&format!("{keyword} x y z"))?,
            false => Vec3::ONE,
        };
        self.scene.lights.push(Light { position, color });
        Ok(())
    }

    pub(super) fn surface(&mut self, file: &mut File<'_>) -> Checked {
        let material = material(file.numbers("fm")?);
        // Included files state the same over and over.
        let materials = &mut self.scene.materials;
        let known = materials.iter().rev().take(64).position(|known| *known == material);
        self.material = Some(match known {
            Some(back) => (materials.len() - 1 - back) as u32,
            None => {
                materials.push(material);
                materials.len() as u32 - 1
            }
        });
        Ok(())
    }

    /// The material of what is stated now.
    fn material(&mut self) -> u32 {
        match self.material {
            Some(material) => material,
            None => self.surfaces.index(&mut self.scene.materials, None),
        }
    }

    pub(super) fn sphere(&mut self, file: &mut File<'_>, keyword: Word<'_>) -> Checked {
        let [x, y, z, radius] = file.numbers("s")?;
        self.state("sphere");
        let (center, radius) = (Vec3::new(x, y, z), radius.abs());
        if radius == 0.0 {
            self.counts.without_radius += 1;
            return Ok(());
        }
        if !(center.abs() + Vec3::splat(radius)).is_finite() {
            let message = "the sphere reaches beyond the range of single precision";
            return Err(file.error(keyword.at, message));
        }
        let material = self.material();
        self.scene.spheres.push(Sphere { center, radius, material });
        Ok(())
    }

    pub(super) fn cone(&mut self, file: &mut File<'_>, keyword: Word<'_>) -> Checked {
        let [x, y, z, base_radius, ax, ay, az, apex_radius] = file.numbers("c")?;
        self.state(if base_radius == apex_radius { "cylinder" } else { "cone" });
        let (base, apex) = (Vec3::new(x, y, z), Vec3::new(ax, ay, az));
        let [base_radius, apex_radius] = [base_radius.abs(), apex_radius.abs()];
        let radius = base_radius.max(apex_radius);
        if radius == 0.0 || base == apex {
            self.counts.flat_cones += 1;
            return Ok(());
        }
        if !(base.abs().max(apex.abs()) + Vec3::splat(radius)).is_finite() {
            let message = "the cone reaches beyond the range of single precision";
            return Err(file.error(keyword.at, message));
        }
        let material = self.material();
        self.scene.cones.push(Cone { base, base_radius, apex, apex_radius, material });
        Ok(())
    }

    pub(super) fn polygon(&mut self, file: &mut File<'_>, keyword: &str) -> Checked {
        let patch = keyword == "pp";
        let count = file.count(3, &format!("vertices after '{keyword}'"))?;
        let first = self.first();
        for _ in 0..count {
            self.corner(file, keyword, patch)?;
        }
        self.state(if patch { "patch" } else { "polygon" });
        self.triangulate(first, patch);
        Ok(())
    }

    /// One triangle with places in a texture, which are read over.
    pub(super) fn textured(&mut self, file: &mut File<'_>, keyword: &str) -> Checked {
        let patch = keyword == "ttp";
        file.name("the name of a texture")?;
        let first = self.first();
        for _ in 0..3 {
            self.corner(file, keyword, patch)?;
            file.numbers::<2>(keyword)?;
        }
        self.state(if patch { "textured patch" } else { "textured triangle" });
        self.counts.textured += 1;
        self.triangulate(first, patch);
        Ok(())
    }

    /// A triangle with normals, at several times.
    pub(super) fn moving(&mut self, file: &mut File<'_>) -> Checked {
        let count = file.count(1, "times after 'tpa'")?;
        let mut keys = Vec::new();
        for _ in 0..count {
            let [time] = file.numbers("tpa")?;
            let mut corners = [[Vec3::ZERO; 2]; 3];
            for corner in &mut corners {
                *corner = [file.vector("tpa")?, file.vector("tpa")?];
            }
            keys.push((time, corners));
        }
        let first @ [position, normal] = self.first();
        for [position, normal] in keys[0].1 {
            self.scene.mesh.positions.push(position);
            self.scene.mesh.normals.push(normal);
        }
        self.state("animated triangle");
        self.triangulate(first, true);
        self.moving_triangles.push(MovingTriangle { position, normal, keys });
        Ok(())
    }

    pub(super) fn mesh(&mut self, file: &mut File<'_>) -> Checked {
        let [position, normal] = self.first();
        file.expect("vertices")?;
        let vertices = file.count(0, "vertices")?;
        for _ in 0..vertices {
            let vertex = file.vector("vertices")?;
            self.scene.mesh.positions.push(vertex);
        }
        let mut normals = None;
        if file.take(b"normals") {
            let count = file.count(0, "normals")?;
            for _ in 0..count {
                let normal = file.vector("normals")?;
                self.scene.mesh.normals.push(normal);
            }
            normals = Some(count);
        }
        let mut places = None;
        if file.take(b"texturecoords") {
            let count = file.count(0, "texture coordinates")?;
            file.name("the name of a texture")?;
            for _ in 0..count {
                file.numbers::<2>("texturecoords")?;
            }
            places = Some(count);
        }
        file.expect("triangles")?;
        let triangles = file.count(0, "triangles")?;
        let material = self.material();
        for _ in 0..triangles {
            let corners = indices(file, "vertex", vertices)?;
            let of_normals = match normals {
                Some(normals) => Some(indices(file, "normal", normals)?),
                None => None,
            };
            if let Some(places) = places {
                indices(file, "texture coordinate", places)?;
                self.counts.textured += 1;
            }
            self.scene.mesh.triangles.push(Triangle {
                position: corners.map(|index| (position + index) as u32),
                normal: of_normals.map(|corners| corners.map(|index| (normal + index) as u32)),
                uv: None,
                material,
            });
        }
        *self.scene.facts.stated.entry("mesh triangle").or_default() += triangles;
        Ok(())
    }

    pub(super) fn key_frames(&mut self, file: &mut File<'_>) -> Checked {
        let name = decode(file.name("the name of what is animated")?.text).into_owned();
        file.expect("{")?;
        let mut keys = Keys::default();
        loop {
            if file.take(b"transl") {
                for number in 0..file.count(4, "keys after 'transl'")? {
                    let [time, x, y, z, ..] = file.numbers::<7>("transl")?;
                    keys.translation.add(number, time, Vec3::new(x, y, z).as_dvec3());
                }
            } else if file.take(b"rot") {
                for number in 0..file.count(4, "keys after 'rot'")? {
                    let [time, x, y, z, degrees, ..] = file.numbers::<8>("rot")?;
                    let axis = Vec3::new(x, y, z).as_dvec3();
                    keys.rotation.add(number, time, (axis, degrees.into()));
                }
            } else if file.take(b"scale") {
                for number in 0..file.count(4, "keys after 'scale'")? {
                    let [time, x, y, z, ..] = file.numbers::<7>("scale")?;
                    keys.scale.add(number, time, Vec3::new(x, y, z).as_dvec3());
                }
            } else if file.take(b"visibility") {
                for _ in 0..file.count(1, "keys after 'visibility'")? {
                    let [time, visible] = file.numbers("visibility")?;
                    keys.visibility.push((time, visible != 0.0));
                }
            } else {
                break;
            }
        }
        match file.take(b"}") {
            true => self.keys.insert(name, keys),
            false => return Err(file.expected("transl, rot, scale, visibility or '}'")),
        };
        Ok(())
    }

    /// Where the next position and normal will be.
    fn first(&self) -> [usize; 2] {
        [self.scene.mesh.positions.len(), self.scene.mesh.normals.len()]
    }

    fn corner(&mut self, file: &mut File<'_>, keyword: &str, normal: bool) -> Checked {
        let position = file.vector(keyword)?;
        self.scene.mesh.positions.push(position);
        if normal {
            let normal = file.vector(keyword)?;
            self.scene.mesh.normals.push(normal);
        }
        Ok(())
    }

    /// Makes triangles of the corners from there on.
    fn triangulate(&mut self, [first, first_normal]: [usize; 2], normals: bool) {
        let material = self.material();
        let mesh = &mut self.scene.mesh;
        let triangles = self.triangulator.polygon(&mesh.positions[first..]).iter();
        mesh.triangles.extend(triangles.map(|corners| Triangle {
            position: corners.map(|corner| first as u32 + corner),
            normal: normals.then(|| corners.map(|corner| first_normal as u32 + corner)),
            uv: None,
            material,
        }));
    }

    fn state(&mut self, kind: &'static str) {
        *self.scene.facts.stated.entry(kind).or_default() += 1;
    }
}

/// Three indices below a limit.
fn indices(file: &mut File<'_>, what: &str, limit: u64) -> Checked<[usize; 3]> {
    let mut indices = [0; 3];
    for index in &mut indices {
        let Some(greatest) = limit.checked_sub(1) else {
            return Err(file.expected(&format!("no {what} index, for there are none")));
        };
        let expected = format!("a {what} index of 0 to {greatest}");
        *index = file.integer(0..=greatest, &expected)? as usize;
    }
    Ok(indices)
}
