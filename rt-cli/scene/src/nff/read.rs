//! The NFF reader.

use glam::{DVec3, Vec3};

use super::{Surface, Surfaces};
use crate::diag::{Diagnostic, Error, MAX_DIAGNOSTICS, plural};
use crate::model::{Cone, Light, Scene, Skipped, Sphere, Triangle, View};
use crate::spd::white_light;
use crate::text::{Lexer, Source, Word};
use crate::triangulate::Triangulator;

/// Pictures are at most so many pixels wide or high.
const MAX_RESOLUTION: u32 = 1 << 16;

/// Reads an NFF text. `name` is what messages call it.
pub fn parse(bytes: &[u8], name: &str) -> Result<Scene, Error> {
    let source = Source::new(name, bytes, "NFF")?;
    let mut reader = Reader {
        source,
        lexer: Lexer::new(source.text),
        ahead: None,
        scene: Scene { name: crate::base_name(name), ..Scene::default() },
        uncolored: Vec::new(),
        surface: None,
        surfaces: Surfaces::default(),
        triangulator: Triangulator::default(),
        counts: Counts::default(),
    };
    let errors = reader.run();
    if errors.is_empty() { Ok(reader.finish()) } else { Err(Error::Invalid(errors)) }
}

/// What is told at the end.
#[derive(Default)]
struct Counts {
    inside_out: u64,
    without_radius: u64,
    inside_out_cones: u64,
    flat_cones: u64,
}

struct Reader<'a> {
    source: Source<'a>,
    lexer: Lexer<'a>,
    ahead: Option<Word<'a>>,
    scene: Scene,
    /// Lights that state no colour.
    uncolored: Vec<usize>,
    /// What `f` states, until something needs it.
    surface: Option<Surface>,
    surfaces: Surfaces,
    triangulator: Triangulator,
    counts: Counts,
}

/// A statement that is wrong.
type Checked<T = ()> = Result<T, Diagnostic>;

impl<'a> Reader<'a> {
    fn run(&mut self) -> Vec<Diagnostic> {
        let mut errors = Vec::new();
        while let Some(keyword) = self.word() {
            if let Err(diagnostic) = self.statement(keyword) {
                errors.push(diagnostic);
                if errors.len() == MAX_DIAGNOSTICS {
                    break;
                }
                self.recover();
            }
        }
        let scene = &self.scene;
        if errors.is_empty() && scene.facts.stated.is_empty() {
            let message = "nothing to draw: no 's', 'p', 'pp' or 'c' statement";
            errors.push(Diagnostic::whole(self.source.name, message));
        }
        errors
    }

    fn statement(&mut self, keyword: Word<'a>) -> Checked {
        match keyword.text {
            b"v" => self.view(keyword),
            b"b" => self.vector("b").map(|color| self.scene.background = Some(color)),
            b"l" => self.light(),
            b"f" => self.surface(),
            b"s" => self.sphere(keyword),
            b"c" => self.cone(keyword),
            b"p" => self.polygon("p"),
            b"pp" => self.polygon("pp"),
            _ => {
                let expected = "expected a statement (v, b, l, f, s, p, pp or c)";
                Err(self.error(keyword.at, format!("{expected}, found {}", keyword.quoted())))
            }
        }
    }

    /// Goes to the next statement.
    fn recover(&mut self) {
        while let Some(word) = self.word() {
            if matches!(word.text, b"v" | b"b" | b"l" | b"f" | b"s" | b"c" | b"p" | b"pp") {
                self.ahead = Some(word);
                return;
            }
        }
    }

    fn view(&mut self, keyword: Word<'a>) -> Checked {
        let (mut eye, mut target, mut up, mut fov_y, mut size) = (None, None, None, None, None);
        while let Some(word) = self.word() {
            match word.text {
                b"from" => eye = Some(self.vector("from")?),
                b"at" => target = Some(self.vector("at")?),
                b"up" => up = Some(self.vector("up")?),
                b"angle" => fov_y = Some(self.angle()?),
                b"hither" => drop(self.numbers::<1>("hither")?),
                b"yon" => drop(self.numbers::<1>("yon")?),
                b"resolution" => size = Some((self.resolution()?, self.resolution()?)),
                _ => {
                    self.ahead = Some(word);
                    break;
                }
            }
        }
        let missing = |name| self.error(keyword.at, format!("expected '{name}' after 'v'"));
        let view = View {
            eye: eye.ok_or_else(|| missing("from"))?,
            target: target.ok_or_else(|| missing("at"))?,
            up: up.ok_or_else(|| missing("up"))?,
            fov_y: fov_y.ok_or_else(|| missing("angle"))?,
            size,
        };
        let sight = view.target.as_dvec3() - view.eye.as_dvec3();
        if sight == DVec3::ZERO {
            return Err(self.error(keyword.at, "'from' and 'at' are the same point".to_owned()));
        }
        if sight.cross(view.up.as_dvec3()) == DVec3::ZERO {
            return Err(self.error(keyword.at, "'up' is along the line of sight".to_owned()));
        }
        self.scene.view = Some(view);
        Ok(())
    }

    fn angle(&mut self) -> Checked<f32> {
        let word = self.word();
        let at = word.map_or(self.lexer.at(), |word| word.at);
        self.ahead = word;
        let [angle] = self.numbers("angle")?;
        if angle > 0.0 && angle < 180.0 {
            return Ok(angle);
        }
        Err(self.error(at, format!("expected an angle between 0 and 180 degrees, found {angle}")))
    }

    fn resolution(&mut self) -> Checked<u32> {
        let expected = format!("a resolution from 1 to {MAX_RESOLUTION}");
        self.integer(&expected, |&pixels: &u32| (1..=MAX_RESOLUTION).contains(&pixels))
    }

    fn light(&mut self) -> Checked {
        let position = self.vector("l")?;
        let next = self.word();
        self.ahead = next;
        let mut color = Vec3::ZERO;
        if next.is_some_and(|word| word.number().is_ok()) {
            color = self.vector("l x y z")?;
        } else {
            self.uncolored.push(self.scene.lights.len());
        }
        self.scene.lights.push(Light { position, color });
        Ok(())
    }

    fn surface(&mut self) -> Checked {
        let surface: Surface = self.numbers("f")?;
        self.surface = Some(surface);
        // A later draft of the format adds an ambient part.
        let next = self.word();
        self.ahead = next.filter(|word| word.number().is_err());
        Ok(())
    }

    /// The material of what is stated now.
    fn material(&mut self) -> u32 {
        self.surfaces.index(&mut self.scene.materials, self.surface)
    }

    fn sphere(&mut self, keyword: Word<'a>) -> Checked {
        let [x, y, z, radius] = self.numbers("s")?;
        self.state("sphere");
        let center = Vec3::new(x, y, z);
        if radius == 0.0 {
            self.counts.without_radius += 1;
            return Ok(());
        }
        self.counts.inside_out += u64::from(radius < 0.0);
        let radius = radius.abs();
        if !(center.abs() + Vec3::splat(radius)).is_finite() {
            let message = "the sphere reaches beyond the range of single precision".to_owned();
            return Err(self.error(keyword.at, message));
        }
        let material = self.material();
        self.scene.spheres.push(Sphere { center, radius, material });
        Ok(())
    }

    fn cone(&mut self, keyword: Word<'a>) -> Checked {
        let numbers = self.numbers::<8>("c")?;
        let [x, y, z, base_radius, apex_x, apex_y, apex_z, apex_radius] = numbers;
        let (base, apex) = (Vec3::new(x, y, z), Vec3::new(apex_x, apex_y, apex_z));
        self.state(if base_radius == apex_radius { "cylinder" } else { "cone" });
        let [base_size, apex_size] = [base_radius, apex_radius].map(f32::abs);
        if base_size.max(apex_size) == 0.0 || base == apex {
            self.counts.flat_cones += 1;
            return Ok(());
        }
        self.counts.inside_out_cones += u64::from(base_radius.min(apex_radius) < 0.0);
        let reach = base.abs().max(apex.abs()) + Vec3::splat(base_size.max(apex_size));
        if !reach.is_finite() {
            let message = "the cone reaches beyond the range of single precision".to_owned();
            return Err(self.error(keyword.at, message));
        }
        let material = self.material();
        let (base_radius, apex_radius) = (base_size, apex_size);
        self.scene.cones.push(Cone { base, base_radius, apex, apex_radius, material });
        Ok(())
    }

    fn polygon(&mut self, keyword: &str) -> Checked {
        let patch = keyword == "pp";
        let expected = format!("3 or more vertices after '{keyword}'");
        let count: u64 = self.integer(&expected, |&count| count >= 3)?;
        let mesh = &self.scene.mesh;
        let (first, first_normal) = (mesh.positions.len() as u32, mesh.normals.len() as u32);
        for _ in 0..count {
            let position = self.vector(keyword)?;
            self.scene.mesh.positions.push(position);
            if patch {
                let normal = self.vector(keyword)?;
                self.scene.mesh.normals.push(normal);
            }
        }
        self.state(if patch { "patch" } else { "polygon" });
        let material = self.material();
        let mesh = &mut self.scene.mesh;
        let corners = &mesh.positions[first as usize..];
        mesh.triangles.extend(self.triangulator.polygon(corners).iter().map(|corners| Triangle {
            position: corners.map(|corner| first + corner),
            normal: patch.then(|| corners.map(|corner| first_normal + corner)),
            uv: None,
            material,
        }));
        Ok(())
    }

    fn state(&mut self, kind: &'static str) {
        *self.scene.facts.stated.entry(kind).or_default() += 1;
    }

    fn finish(mut self) -> Scene {
        let scene = &mut self.scene;
        for &light in &self.uncolored {
            scene.lights[light].color = white_light(scene.lights.len());
        }
        let counts = self.counts;
        let mut skip = |what: &str, why: &str, count| {
            if count > 0 {
                let (what, why) = (what.to_owned(), why.to_owned());
                scene.facts.skipped.push(Skipped { what, why, count });
            }
        };
        skip("sphere", "its radius is zero", counts.without_radius);
        skip("cone", "its ends are one point, or both its radii are zero", counts.flat_cones);
        let mut warn = |count: u64, noun: &str, what: &str| {
            if count > 0 {
                let many = plural(count, noun);
                scene.facts.warnings.push(format!("{}: {many} {what}", self.source.name));
            }
        };
        let of_negative = "of negative radius, to be seen from inside only: seen from both sides";
        warn(counts.inside_out, "sphere", of_negative);
        warn(counts.inside_out_cones, "cone", of_negative);
        scene.facts.warnings.extend(self.triangulator.warning());
        scene.finish();
        self.scene
    }

    fn vector(&mut self, keyword: &str) -> Checked<Vec3> {
        self.numbers(keyword).map(Vec3::from_array)
    }

    fn numbers<const N: usize>(&mut self, keyword: &str) -> Checked<[f32; N]> {
        let mut numbers = [0.0; N];
        for (found, number) in numbers.iter_mut().enumerate() {
            let end = self.lexer.at();
            let word = self.word();
            let value = match word {
                // A word here is the next statement, or a broken number.
                Some(word)
                    if word.text[0].is_ascii_alphabetic() && word.parse::<f32>().is_none() =>
                {
                    Err(None)
                }
                Some(word) => word.number().map_err(|message| Some((word.at, message))),
                None => Err(None),
            };
            *number = value.map_err(|wrong| {
                self.ahead = word;
                let s = if N == 1 { "" } else { "s" };
                let short = || format!("expected {N} number{s} after '{keyword}', found {found}");
                let (at, message) = wrong.unwrap_or_else(|| (end, short()));
                self.error(at, message)
            })?;
        }
        Ok(numbers)
    }

    fn integer<T: std::str::FromStr>(
        &mut self,
        expected: &str,
        is_good: impl Fn(&T) -> bool,
    ) -> Checked<T> {
        let end = self.lexer.at();
        let Some(word) = self.word() else {
            return Err(self.error(end, format!("expected {expected}, found the end of the file")));
        };
        word.parse().filter(is_good).ok_or_else(|| {
            self.ahead = Some(word);
            self.error(word.at, format!("expected {expected}, found {}", word.quoted()))
        })
    }

    /// The next word, on whatever line.
    fn word(&mut self) -> Option<Word<'a>> {
        if let Some(word) = self.ahead.take() {
            return Some(word);
        }
        loop {
            let word = self.lexer.word();
            if word.is_some() || !self.lexer.next_line() {
                return word;
            }
        }
    }

    fn error(&self, at: usize, message: String) -> Diagnostic {
        self.source.diagnostic(at, message)
    }
}
