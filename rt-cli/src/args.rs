//! The command line.

mod compare;
mod convert;
mod machine;
mod output;
mod paper;
mod values;

pub(crate) use compare::CompareArgs;
pub(crate) use convert::{CompletionsArgs, ConvertArgs};
pub(crate) use machine::{BuildArgs, MachineArgs, best_level};
pub(crate) use output::{PictureOutputArgs, picture_format};
pub(crate) use paper::{
    GeimerMuellerArgs, Paper, PaperArgs, ShadingPaperArgs, Wald2001Args, Wald2001Part,
};

use std::ffi::{OsStr, OsString};
use std::path::PathBuf;

use clap::{Args as Group, Parser, Subcommand, ValueEnum};
use glam::Vec3;
use rt_accuracy::Setting;
use rt_render::{Crop, Integrator, Method};
use rt_scene::{Light, Scene};

use crate::error::Error;
use values::{angle, color, crop, light, offset, scale, size, tolerance, vec3};

/// What every command takes as a scene.
const SCENE: &str =
    "An OBJ, PLY, NFF or AFF file, or spd:NAME[:SIZE] for a procedural scene: spd:balls";

/// A ray tracer that gives the same bits on every machine.
#[derive(Parser)]
#[command(name = "rt", version, max_term_width = 100)]
#[command(after_help = "Begin with:\n  \
    rt render spd:balls -o balls.png\n  \
    rt help render\n\n\
    Exit codes: 0 done, 1 failed, 2 wrong usage, 3 a threshold was missed, 130 interrupted")]
pub(crate) struct Args {
    /// What to do.
    #[command(subcommand)]
    pub(crate) command: Command,
}

#[derive(Subcommand)]
#[allow(clippy::large_enum_variant, reason = "there is one of it")]
pub(crate) enum Command {
    Render(RenderArgs),
    Gen(GenArgs),
    Info(InfoArgs),
    Bench(BenchArgs),
    Accuracy(AccuracyArgs),
    Chart(ChartArgs),
    Compare(CompareArgs),
    Convert(ConvertArgs),
    Paper(PaperArgs),
    Completions(CompletionsArgs),
}

/// Render one picture of a scene.
///
/// Without further flags the camera is the scene's own, or fitted to it; the lights are the scene's
/// own, or one at the eye; every core works at the best level that the CPU has. Where nothing of a
/// scene can be seen, the picture shows the background.
///
/// A file that is there already is replaced when the picture is complete, and not before. Ctrl-C keeps
/// what is finished in FILE.part, and --resume goes on with it.
#[derive(Group)]
#[command(after_help = "Examples:\n  \
    rt render bunny.obj -o bunny.png\n  \
    rt render spd:balls -s 1024x1024 -o balls.png\n  \
    rt render room.obj --eye 1,2,5 --target 0,1,0 --light 0,3,0 -o room.png\n  \
    rt render spd:tree -s 4096x4096 -o tree.exr --resume\n  \
    rt render spd:balls --crop 200,150,64,64 -o part.png")]
pub(crate) struct RenderArgs {
    #[arg(help = SCENE)]
    pub(crate) scene: OsString,
    #[command(flatten)]
    pub(crate) output: PictureOutputArgs,
    #[command(flatten)]
    pub(crate) opening: OpenArgs,
    #[command(flatten)]
    pub(crate) picture: PictureArgs,
    #[command(flatten)]
    pub(crate) shading: ShadingArgs,
    #[command(flatten)]
    pub(crate) precision: PrecisionArgs,
    #[command(flatten)]
    pub(crate) machine: MachineArgs,

    /// Say nothing but errors.
    #[arg(short, long, help_heading = "Talk", conflicts_with = "verbose")]
    pub(crate) quiet: bool,
    /// Say more: what was read and built, and what each kind of ray took.
    #[arg(short, long, help_heading = "Talk")]
    pub(crate) verbose: bool,
    /// How progress is shown: auto is a bar on a terminal, lines elsewhere and under CI.
    #[arg(long, value_enum, value_name = "HOW", default_value_t, help_heading = "Talk")]
    pub(crate) progress: ProgressKind,
    /// Write counts and times to a .json file; - for standard output.
    #[arg(long, value_name = "FILE", help_heading = "Talk")]
    pub(crate) stats_json: Option<PathBuf>,
}

/// Size and camera.
#[derive(Group)]
#[command(next_help_heading = "Picture")]
pub(crate) struct PictureArgs {
    /// Width and height in pixels [default: the scene's, or 512x512].
    #[arg(short, long, value_name = "WxH", value_parser = size)]
    pub(crate) size: Option<(u32, u32)>,
    /// Render only a rectangle of it, as it is in the whole: the column and row of its upper left
    /// corner, its width and height [default: all].
    #[arg(long, value_name = "X,Y,W,H", value_parser = crop, allow_hyphen_values = true)]
    pub(crate) crop: Option<Crop>,
    /// Where the camera is [default: the scene's, or such that all is in the picture].
    #[arg(long, value_name = "X,Y,Z", value_parser = vec3, allow_hyphen_values = true)]
    pub(crate) eye: Option<Vec3>,
    /// What the camera looks at [default: the scene's, or the middle of its bounds].
    #[arg(long, value_name = "X,Y,Z", value_parser = vec3, allow_hyphen_values = true)]
    pub(crate) target: Option<Vec3>,
    /// What is up in the picture [default: the scene's, or 0,1,0].
    #[arg(long, value_name = "X,Y,Z", value_parser = vec3, allow_hyphen_values = true)]
    pub(crate) up: Option<Vec3>,
    /// The vertical angle of view [default: the scene's, or 40].
    #[arg(long, value_name = "DEGREES", value_parser = angle)]
    pub(crate) fov: Option<f32>,
    /// Rays through each pixel, in a fixed pattern, averaged: smoother edges.
    #[arg(long, value_name = "N", default_value_t = 1, value_parser = clap::value_parser!(u32).range(1..=65536))]
    pub(crate) spp: u32,
}

/// Light and shading.
#[derive(Group)]
#[command(next_help_heading = "Shading")]
pub(crate) struct ShadingArgs {
    /// A point light, white unless a colour follows; may be repeated [default: the scene's, or one
    /// at the eye].
    #[arg(long, value_name = "X,Y,Z[,R,G,B]", value_parser = light, allow_hyphen_values = true)]
    pub(crate) light: Vec<Light>,
    /// The linear colour behind the scene [default: the scene's, or 0.05,0.05,0.06].
    #[arg(long, value_name = "R,G,B", value_parser = color, allow_hyphen_values = true)]
    pub(crate) background: Option<Vec3>,
    /// What is computed of a hit.
    #[arg(long, value_enum, value_name = "KIND", default_value_t)]
    pub(crate) integrator: IntegratorArg,
    /// How often a ray may be reflected or refracted.
    #[arg(long, value_name = "N", default_value_t = 5)]
    pub(crate) depth: u32,
    /// Let light through everything.
    #[arg(long)]
    pub(crate) no_shadows: bool,
    /// Estimate square roots and powers in shading: a little faster, by no difference that can be seen,
    /// but not the same bytes on every machine. Rays in packets of one are shaded as without it.
    #[arg(long)]
    pub(crate) relaxed: bool,
    /// Leave out the pictures on surfaces.
    #[arg(long)]
    pub(crate) no_textures: bool,
    /// Leave out the backs of opaque surfaces, as if a closed room had no walls to look at from
    /// outside.
    #[arg(long)]
    pub(crate) one_sided: bool,
}

/// How a scene is opened.
#[derive(Group)]
pub(crate) struct OpenArgs {
    /// Take it for an error if a file that the scene names cannot be read: a material library or a
    /// texture.
    #[arg(long)]
    strict: bool,
    #[command(flatten)]
    tessellate: TessellateArgs,
}

/// What is made of a scene before anything else.
#[derive(Group)]
pub(crate) struct TessellateArgs {
    /// Make triangles of all that is curved: 12 N² of a sphere, 8 N of a cone or cylinder. Without
    /// N it is 4, at which the Standard Procedural Databases count their triangles.
    #[arg(long, value_name = "N", num_args = 0..=1, default_missing_value = "4",
          value_parser = clap::value_parser!(u32).range(1..=1024))]
    tessellate: Option<u32>,
}

impl OpenArgs {
    /// A scene by its name, or its tessellation.
    pub(crate) fn open(&self, name: &OsStr) -> Result<Scene, Error> {
        let scene = rt_scene::open(name)?;
        match self.strict && !scene.facts.missing.is_empty() {
            true => Err(Error::Missing(scene.facts.missing)),
            false => self.tessellate.apply(scene),
        }
    }
}

impl TessellateArgs {
    /// A scene that was opened, or its tessellation.
    pub(crate) fn apply(&self, scene: Scene) -> Result<Scene, Error> {
        match self.tessellate {
            Some(resolution) => Ok(rt_scene::tessellate(scene, resolution)?),
            None => Ok(scene),
        }
    }
}

/// How exact the picture is.
#[derive(Group)]
#[command(next_help_heading = "Precision")]
pub(crate) struct PrecisionArgs {
    /// The triangle test. Only the watertight one leaks nothing.
    #[arg(long, value_enum, value_name = "NAME", default_value_t, conflicts_with = "tolerance")]
    kernel: KernelArg,
    /// Over skip arrays, take the cheapest triangle test that is off by less than this many pixels (rt
    /// info tells); elsewhere the watertight one is the cheapest [default: none, which is 0].
    #[arg(long, value_name = "PX", value_parser = tolerance, allow_hyphen_values = true)]
    pub(crate) tolerance: Option<f64>,
}

impl PrecisionArgs {
    /// The triangle test, unless a tolerance chooses it.
    pub(crate) fn method(&self) -> Method {
        match self.kernel {
            KernelArg::Watertight => Method::Watertight,
            KernelArg::MollerTrumbore => Method::MollerTrumbore,
            KernelArg::Wald => Method::Wald,
            KernelArg::Plucker => Method::Plucker,
        }
    }
}

/// Write a procedural scene to a file.
///
/// The extension of the file tells the format: .nff, .aff, or .obj for scenes of polygons alone, which
/// --tessellate makes of any; beside the OBJ go its materials, as .mtl. Without a file, NFF goes to
/// standard output.
#[derive(Group)]
#[command(after_help = "Examples:\n  \
    rt gen balls -o balls.nff\n  \
    rt gen rings --tessellate -o rings.obj\n  \
    rt gen balls --size 2 | less")]
pub(crate) struct GenArgs {
    #[arg(help = names())]
    pub(crate) name: String,
    /// The scene's size factor [default: the scene's own].
    #[arg(long, value_name = "N")]
    pub(crate) size: Option<u32>,
    #[command(flatten)]
    pub(crate) tessellate: TessellateArgs,
    /// The .nff, .obj or .aff file to write; - for standard output [default: -].
    #[arg(short, long, value_name = "FILE")]
    pub(crate) output: Option<PathBuf>,
}

/// Tell what is in a scene, or, without one, what this machine has.
#[derive(Group)]
#[command(after_help = "Examples:\n  rt info bunny.obj\n  rt info --json")]
pub(crate) struct InfoArgs {
    #[arg(help = SCENE)]
    pub(crate) scene: Option<OsString>,
    #[command(flatten)]
    pub(crate) opening: OpenArgs,
    /// Answer as JSON.
    #[arg(long)]
    pub(crate) json: bool,
}

/// Time the primary rays of scenes at every level, side by side.
///
/// One thread; interleaved rounds; the median of each. The first row is the yardstick: one ray at a
/// time on the same BVH, at the scalar level or, where layouts are compared, in plain scalar code.
/// The second is the four-lane code on the scalar level.
#[derive(Group)]
#[command(after_help = "Examples:\n  \
    rt bench bunny.obj spd:balls\n  \
    rt bench bunny.obj --builders\n  \
    rt bench bunny.obj --layouts\n  \
    rt bench spd:balls --json balls.json")]
pub(crate) struct BenchArgs {
    #[arg(value_name = "SCENE", default_value = "spd:balls", help = SCENE)]
    pub(crate) scenes: Vec<OsString>,
    #[command(flatten)]
    pub(crate) opening: OpenArgs,
    /// Width and height in pixels.
    #[arg(short, long, value_name = "WxH", value_parser = size, default_value = "512x512")]
    pub(crate) size: (u32, u32),
    /// Compare the triangle tests of --kernel at the best level, instead of levels: over skip arrays,
    /// which have all, or with another --accel.
    #[arg(long)]
    pub(crate) kernels: bool,
    /// Compare the builders of --builder at the best level, instead of levels.
    #[arg(long, conflicts_with_all = ["kernels", "builder", "accel"])]
    pub(crate) builders: bool,
    /// Compare the layouts of --layout at the best level, instead of levels: with primary rays, and
    /// with those that matt surfaces scatter.
    #[arg(long, conflicts_with_all = ["kernels", "builders", "layout", "accel"])]
    pub(crate) layouts: bool,
    #[command(flatten)]
    pub(crate) build: BuildArgs,
    /// How often everything is timed.
    #[arg(long, value_name = "N", default_value_t = 9, value_parser = clap::value_parser!(u16).range(1..))]
    pub(crate) rounds: u16,
    /// Write the rows to a .json file too; - for standard output, where no table is then.
    #[arg(long, value_name = "FILE")]
    pub(crate) json: Option<PathBuf>,
}

/// Show every kernel every family of inputs that are hard on it, and count what it gets wrong.
///
/// Exact arithmetic is the judge. Each kernel is run at every level that the CPU has, one ray at a
/// time, rays in lanes and primitives in lanes; the table shows rays in lanes at the best level, the
/// file all. If a kernel is less accurate than it is known to be, the exit code is 3.
#[derive(Group)]
#[command(after_help = "Examples:\n  \
    rt accuracy --quick\n  \
    rt accuracy --quick --scale 1e-3 --offset 1e4\n  \
    rt accuracy --json accuracy.json && rt chart --from accuracy.json -o chart.svg")]
pub(crate) struct AccuracyArgs {
    #[command(flatten)]
    pub(crate) measure: MeasureArgs,
    /// Write all rows to a .json file too; - for standard output, where no table is then.
    #[arg(long, value_name = "FILE")]
    pub(crate) json: Option<PathBuf>,
}

/// How much to measure.
#[derive(Group)]
#[group(multiple = true)]
pub(crate) struct MeasureArgs {
    /// Fewer rays: some seconds.
    #[arg(long)]
    quick: bool,
    /// Rays of each family [default: 1000000, or 3584 with --quick].
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(1..=100_000_000))]
    rays: Option<u32>,
    /// How often everything is timed [default: 21, or 5 with --quick].
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u16).range(1..))]
    rounds: Option<u16>,
    /// Which random numbers to use.
    #[arg(long, value_name = "N", default_value_t = 1)]
    pub(crate) seed: u64,
    /// The size of meshes and primitives, instead of what each family has. What kernels are known
    /// to get wrong is not held against them then.
    #[arg(long, value_name = "X", value_parser = scale)]
    scale: Option<f32>,
    /// How far from the origin they are, likewise.
    #[arg(long, value_name = "X", value_parser = offset)]
    offset: Option<f32>,
    /// Say nothing but errors.
    #[arg(short, long)]
    pub(crate) quiet: bool,
}

impl MeasureArgs {
    /// Rays of each family.
    pub(crate) fn rays(&self) -> usize {
        self.rays.unwrap_or(if self.quick { 3_584 } else { 1_000_000 }) as usize
    }

    /// What a family is set to, where it is commonly set to that.
    pub(crate) fn setting(&self, common: Setting) -> Setting {
        Setting {
            seed: self.seed,
            scale: self.scale.unwrap_or(common.scale),
            offset: self.offset.unwrap_or(common.offset),
        }
    }

    /// Whether families are set as they commonly are, but for the random numbers.
    pub(crate) fn is_common(&self) -> bool {
        self.scale.is_none() && self.offset.is_none()
    }

    /// How often everything is timed.
    pub(crate) fn rounds(&self) -> usize {
        self.rounds.unwrap_or(if self.quick { 5 } else { 21 }).into()
    }
}

/// Draw speed against accuracy: what every kernel costs and how often it is wrong.
///
/// Measures as rt accuracy does, or takes files that rt accuracy --json has written, all of one
/// machine. The picture is SVG.
#[derive(Group)]
#[command(after_help = "Examples:\n  \
    rt chart --quick -o accuracy.svg\n  \
    rt chart --from accuracy.json -o accuracy.svg\n  \
    rt chart --from triangles.json boxes.json -o accuracy.svg")]
pub(crate) struct ChartArgs {
    /// The .json files to draw, together; nothing is measured then.
    #[arg(long, value_name = "FILE", num_args = 1.., conflicts_with_all = ["quick", "rays", "rounds", "seed", "scale", "offset"])]
    pub(crate) from: Vec<PathBuf>,
    #[command(flatten)]
    pub(crate) measure: MeasureArgs,
    /// The .svg file to write; - for standard output.
    #[arg(short, long, value_name = "FILE")]
    pub(crate) output: PathBuf,
}

#[derive(Clone, Copy, Default, ValueEnum)]
enum KernelArg {
    /// Of Woop, Benthin and Wald: exact at edges.
    #[default]
    Watertight,
    /// Of Möller and Trumbore: leaks at edges.
    MollerTrumbore,
    /// Of Wald, precomputed: leaks at edges, more so far from the origin.
    Wald,
    /// Of volumes relative to the ray: leaks at vertices.
    Plucker,
}

#[derive(Clone, Copy, Default, ValueEnum)]
pub(crate) enum IntegratorArg {
    /// Phong shading, shadows, mirrors.
    #[default]
    Whitted,
    /// Diffuse colour times the cosine to the viewer.
    Eyelight,
    /// Normals as colours.
    Normals,
    /// Distance as grey.
    Depth,
    /// Nodes and tests of each ray as colours, white at 255: depends on --accel and how it is built.
    Heat,
}

impl From<IntegratorArg> for Integrator {
    fn from(arg: IntegratorArg) -> Integrator {
        match arg {
            IntegratorArg::Whitted => Integrator::Whitted,
            IntegratorArg::Eyelight => Integrator::Eyelight,
            IntegratorArg::Normals => Integrator::Normals,
            IntegratorArg::Depth => Integrator::Depth,
            IntegratorArg::Heat => Integrator::Heat,
        }
    }
}

/// How progress is shown.
#[derive(Clone, Copy, Default, PartialEq, Eq, ValueEnum)]
pub(crate) enum ProgressKind {
    /// A bar on a terminal, lines elsewhere.
    #[default]
    Auto,
    /// A bar with elapsed and remaining time, if this is a terminal.
    Bar,
    /// A line now and then.
    Lines,
    /// A JSON object a line.
    Json,
    /// Nothing.
    None,
}

/// The procedural scenes, for the help.
fn names() -> String {
    let scenes = rt_scene::spd::PROCEDURES.iter().map(|scene| {
        let (least, greatest) = scene.sizes;
        let default = scene.default_size;
        format!("{} ({}; sizes {least} to {greatest}, else {default})", scene.name, scene.about)
    });
    format!("The scene's name: {}", scenes.collect::<Vec<_>>().join(", "))
}

#[cfg(test)]
mod tests {
    use rt_render::Level;

    use super::*;

    #[test]
    fn the_command_line_is_consistent() {
        use clap::CommandFactory;
        Args::command().debug_assert();
    }

    #[test]
    fn every_level_of_this_machine_can_be_asked_for() {
        for level in Level::available() {
            let args = ["rt", "render", "a.obj", "-o", "a.png", "--isa", level.name()];
            assert!(Args::try_parse_from(args).is_ok(), "{level}");
        }
    }
}
