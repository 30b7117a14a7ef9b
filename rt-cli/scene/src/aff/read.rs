//! The AFF reader.

use std::collections::HashMap;

use glam::{DAffine3, DMat3, DVec3};

use super::Loader;
use super::file::{Checked, File};
use super::keys::{Keys, MovingTriangle, at_time, film, turn};
use super::place::{Piece, place, sizes};
use crate::diag::{Diagnostic, Error, plural, reason};
use crate::model::{Scene, Skipped};
use crate::nff::Surfaces;
use crate::text::{Word, decode};
use crate::triangulate::Triangulator;

/// Files and blocks within each other.
const MAX_DEPTH: usize = 64;
/// Files that are included, counting one as often as that happens.
const MAX_INCLUDES: usize = 1 << 16;
/// Bytes of all of them.
const MAX_BYTES: usize = 1 << 28;

/// Reads an AFF text. `name` is what messages call it, `load` gives the files that it includes by the
/// names that it states.
///
/// # Errors
/// The first place where the text, or one that it includes, is wrong; or an included file that
/// cannot be read; or 2^28 bytes of text, or 2^16 inclusions.
pub fn parse(bytes: &[u8], name: &str, load: &mut Loader<'_>) -> Result<Scene, Error> {
    let mut reader = Reader {
        scene: Scene { name: crate::base_name(name), ..Scene::default() },
        load,
        nodes: vec![Node { parent: 0, kind: Kind::Static(DAffine3::IDENTITY) }],
        pieces: vec![Piece { node: 0, first: [0; 5] }],
        keys: HashMap::new(),
        start: None,
        level: 0,
        material: None,
        surfaces: Surfaces::default(),
        triangulator: Triangulator::default(),
        moving_triangles: Vec::new(),
        animated_lights: Vec::new(),
        depth: 0,
        includes: 0,
        bytes: bytes.len(),
        counts: Counts::default(),
    };
    let mut file = File::new(name, bytes)?;
    reader.statements(&mut file, 0, None)?;
    if reader.scene.facts.stated.is_empty() {
        let message =
            "nothing to draw: no 's', 'c', 'p', 'pp', 'tt', 'ttp', 'tpa' or 'm' statement";
        return Err(Error::Invalid(vec![Diagnostic::whole(name, message)]));
    }
    reader.finish()
}

/// What is read over.
#[derive(Default)]
pub(super) struct Counts {
    pub(super) ambient: u64,
    pub(super) textured: u64,
    pub(super) without_radius: u64,
    pub(super) flat_cones: u64,
    pub(super) other_levels: u64,
}

/// A transformation, within another.
struct Node {
    parent: u32,
    kind: Kind,
}

enum Kind {
    Static(DAffine3),
    /// By the keys of a name, which may come later.
    Animated(String),
}

pub(super) struct Reader<'l, 'f> {
    pub(super) scene: Scene,
    load: &'l mut Loader<'f>,
    /// The first is that of the world.
    nodes: Vec<Node>,
    pieces: Vec<Piece>,
    pub(super) keys: HashMap<String, Keys>,
    /// When the animation starts.
    pub(super) start: Option<f32>,
    pub(super) level: u64,
    /// The index of what `fm` stated last, unless `f` came after it.
    pub(super) material: Option<u32>,
    pub(super) surfaces: Surfaces,
    pub(super) triangulator: Triangulator,
    pub(super) moving_triangles: Vec<MovingTriangle>,
    /// Names and indices of lights.
    pub(super) animated_lights: Vec<(String, usize)>,
    depth: usize,
    includes: usize,
    bytes: usize,
    pub(super) counts: Counts,
}

impl Reader<'_, '_> {
    /// Reads statements until the file ends, or the block that was opened there.
    fn statements(
        &mut self,
        file: &mut File<'_>,
        node: u32,
        open: Option<usize>,
    ) -> Result<(), Error> {
        while let Some(keyword) = file.word() {
            if keyword.text == b"}" && open.is_some() {
                return Ok(());
            }
            match keyword.text {
                b"xs" | b"x" => self.transformation(file, keyword, node)?,
                b"i" => self.include(file, keyword, node)?,
                _ => self.statement(file, keyword).map_err(one)?,
            }
        }
        match open {
            Some(at) => Err(one(file.error(at, "this block has no end"))),
            None => Ok(()),
        }
    }

    fn statement(&mut self, file: &mut File<'_>, keyword: Word<'_>) -> Checked {
        match keyword.text {
            b"v" => self.view(file, keyword),
            b"b" => file.vector("b").map(|color| self.scene.background = Some(color)),
            b"l" => self.light(file, "l"),
            b"la" => {
                let name = decode(file.name("the name of a light")?.text).into_owned();
                self.animated_lights.push((name, self.scene.lights.len()));
                self.light(file, "la name")
            }
            b"am" => {
                self.counts.ambient += 1;
                file.vector("am").map(drop)
            }
            b"f" => {
                let surface = file.numbers("f")?;
                self.material = Some(self.surfaces.index(&mut self.scene.materials, Some(surface)));
                Ok(())
            }
            b"fm" => self.surface(file),
            b"s" => self.sphere(file, keyword),
            b"c" => self.cone(file, keyword),
            b"p" => self.polygon(file, "p"),
            b"pp" => self.polygon(file, "pp"),
            b"tt" => self.textured(file, "tt"),
            b"ttp" => self.textured(file, "ttp"),
            b"tpa" => self.moving(file),
            b"m" => self.mesh(file),
            b"d" => file.integer(0..=u64::MAX, "a level of detail").map(|level| self.level = level),
            b"a" => {
                let [start, _] = file.numbers("a")?;
                file.count(1, "frames")?;
                self.start = Some(start);
                Ok(())
            }
            b"k" => self.key_frames(file),
            _ => {
                let message = format!("expected a statement of AFF, found {}", keyword.quoted());
                Err(file.error(keyword.at, message))
            }
        }
    }

    fn transformation(
        &mut self,
        file: &mut File<'_>,
        keyword: Word<'_>,
        node: u32,
    ) -> Result<(), Error> {
        let kind = if keyword.text == b"xs" {
            let numbers = file.numbers::<10>("xs").map_err(one)?.map(f64::from);
            let [sx, sy, sz, ax, ay, az, degrees, tx, ty, tz] = numbers;
            let turned = turn(DVec3::new(ax, ay, az), degrees);
            Kind::Static(DAffine3 {
                matrix3: turned * DMat3::from_diagonal(DVec3::new(sx, sy, sz)),
                translation: DVec3::new(tx, ty, tz),
            })
        } else {
            let name = file.name("the name of a transformation").map_err(one)?;
            Kind::Animated(decode(name.text).into_owned())
        };
        file.expect("{").map_err(one)?;
        self.nodes.push(Node { parent: node, kind });
        let inner = self.nodes.len() as u32 - 1;
        self.enter(file, keyword)?;
        self.stand_in(inner);
        self.statements(file, inner, Some(keyword.at))?;
        self.stand_in(node);
        self.depth -= 1;
        Ok(())
    }

    fn include(&mut self, file: &mut File<'_>, keyword: Word<'_>, node: u32) -> Result<(), Error> {
        let level = file.integer(0..=u64::MAX, "a level of detail").map_err(one)?;
        let name = file.name("the name of a file").map_err(one)?;
        if level > self.level {
            self.counts.other_levels += 1;
            return Ok(());
        }
        self.includes += 1;
        if self.includes > MAX_INCLUDES {
            let message = format!("more than {MAX_INCLUDES} files are included");
            return Err(one(file.error(keyword.at, message)));
        }
        let shown = decode(name.text);
        let bytes = (self.load)(&shown).map_err(|error| {
            one(file.error(name.at, format!("cannot read {}: {}", name.quoted(), reason(&error))))
        })?;
        self.bytes = self.bytes.saturating_add(bytes.len());
        if self.bytes > MAX_BYTES {
            let message = format!("more than {MAX_BYTES} bytes are included");
            return Err(one(file.error(keyword.at, message)));
        }
        self.enter(file, keyword)?;
        self.statements(&mut File::new(&shown, &bytes)?, node, None)?;
        self.depth -= 1;
        Ok(())
    }

    /// Goes one deeper.
    fn enter(&mut self, file: &File<'_>, keyword: Word<'_>) -> Result<(), Error> {
        self.depth += 1;
        match self.depth <= MAX_DEPTH {
            true => Ok(()),
            false => {
                let message =
                    format!("files and blocks are within each other more than {MAX_DEPTH} times");
                Err(one(file.error(keyword.at, message)))
            }
        }
    }

    /// What comes next is within a transformation.
    fn stand_in(&mut self, node: u32) {
        let first = sizes(&self.scene);
        match self.pieces.last_mut() {
            // Nothing came in between.
            Some(last) if last.first == first => last.node = node,
            _ => self.pieces.push(Piece { node, first }),
        }
    }

    fn finish(mut self) -> Result<Scene, Error> {
        let start = self.start.unwrap_or(0.0);
        for triangle in std::mem::take(&mut self.moving_triangles) {
            let corners = at_time(&triangle.keys, start);
            for (nth, [position, normal]) in corners.into_iter().enumerate() {
                self.scene.mesh.positions[triangle.position + nth] = position;
                self.scene.mesh.normals[triangle.normal + nth] = normal;
            }
        }
        let mut late: u64 = 0;
        let mut pose = |name: &str| match self.keys.get(name) {
            Some(keys) => {
                late += u64::from(keys.is_late(start));
                keys.is_visible(start).then(|| keys.pose())
            }
            None => Some(DAffine3::IDENTITY),
        };
        let mut to_world: Vec<Option<DAffine3>> = Vec::with_capacity(self.nodes.len());
        for (index, node) in self.nodes.iter().enumerate() {
            let own = match &node.kind {
                Kind::Static(matrix) => Some(*matrix),
                Kind::Animated(name) => pose(name),
            };
            // A node comes after its parent; the first has none.
            let parent = if index == 0 { own } else { to_world[node.parent as usize] };
            to_world.push(match index {
                0 => own,
                _ => parent.zip(own).map(|(parent, own)| parent * own),
            });
        }
        for (name, light) in &self.animated_lights {
            let keys = self.keys.get(name);
            late += u64::from(keys.is_some_and(|keys| keys.is_late(start)));
            if let Some(moved) = keys.and_then(Keys::translation) {
                self.scene.lights[*light].position = moved.as_vec3();
            }
        }
        if let (Some(keys), Some(view)) = (self.keys.get("camera"), &mut self.scene.view) {
            late += u64::from(keys.is_late(start));
            film(keys, view);
        }
        place(&mut self.scene, &self.pieces, &to_world)?;
        self.tell(late);
        self.scene.finish();
        Ok(self.scene)
    }

    /// Tells what was left out.
    fn tell(&mut self, late: u64) {
        let facts = &mut self.scene.facts;
        let counts = &self.counts;
        for (what, why, count) in [
            ("am", "ambient light is not drawn", counts.ambient),
            ("texture", "textures of AFF are not read", counts.textured),
            ("sphere", "its radius is zero", counts.without_radius),
            ("cone", "its ends are one point, or both its radii are zero", counts.flat_cones),
            ("i", "it is of a higher level of detail", counts.other_levels),
        ] {
            if count > 0 {
                let (what, why) = (what.to_owned(), why.to_owned());
                facts.skipped.push(Skipped { what, why, count });
            }
        }
        if self.start.is_some() {
            facts.warnings.push("of the animation only the first frame is read".to_owned());
        }
        if late > 0 {
            let many = plural(late, "animated name");
            facts.warnings.push(format!("{many} moved before the first frame: shown as before"));
        }
        facts.warnings.extend(self.triangulator.warning());
    }
}

fn one(diagnostic: Diagnostic) -> Error {
    Error::Invalid(vec![diagnostic])
}
