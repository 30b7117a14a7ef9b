//! `rt render`.

mod keep;

use std::time::Instant;

use glam::Vec3;
use rt_render::precision::Over;
use rt_render::{Aabb, Job, Plan, World, check_crop, check_size, fitted_view, precision};
use rt_scene::View;

use crate::args::{PictureArgs, RenderArgs};
use crate::error::Error;
use crate::output::{self, Output};
use crate::report::{self, Kernel, Rendered};
use crate::ui;
use keep::Keep;

/// The angle of view of a fitted camera, in degrees.
const FOV: f32 = 40.0;

/// The size of a picture of a scene that states none.
pub(crate) const SIZE: (u32, u32) = (512, 512);

/// The linear colour behind scenes that state none.
const BACKGROUND: Vec3 = Vec3::new(0.05, 0.05, 0.06);

/// Makes one picture. Triangles without area can't be seen, but a scene that has no others still
/// has a picture: that of its background, with the reader's warning.
pub(crate) fn run(args: &RenderArgs) -> Result<(), Error> {
    let interrupt = ui::Interrupt::new().map_err(Error::Signal)?;
    let exec = args.machine.exec()?;
    let threads = args.machine.threads();
    // Before any work: what cannot be written is not worth rendering.
    let format = args.output.format()?;
    let output = Output::open(&args.output.path)?;
    let stats = args.stats_json.as_deref().map(output::open_json).transpose()?;
    if stats.as_ref().is_some_and(|stats| stats.is_same(&output)) {
        return Err(Error::SameOutput(args.output.path.clone()));
    }
    let keep = Keep::new(&args.output, &output)?;
    args.picture.size.map_or(Ok(()), check_size)?;

    let start = Instant::now();
    let mut scene = args.opening.open(&args.scene)?;
    if !args.quiet {
        ui::warnings(&scene);
    }
    if args.shading.no_textures {
        scene.remove_textures();
    }
    if args.shading.one_sided {
        scene.materials.iter_mut().for_each(|material| material.one_sided = true);
    }
    if args.verbose {
        let (name, took) = (&scene.name, report::time(start.elapsed()));
        ui::say(&format!("{name}: opened in {took}: {}", report::contents(&scene)));
    }
    let own = (scene.view.take(), std::mem::take(&mut scene.lights), scene.background);
    let (own_view, own_lights, own_background) = own;
    let name = scene.name.clone();
    let stated = report::stated(&scene);
    let size = picture_size(&args.picture, own_view.as_ref());
    args.picture.crop.map_or(Ok(()), |crop| check_crop(crop, size))?;
    let view = view(&args.picture, own_view, &rt_render::bounds(&scene), size);
    let accel = args.machine.accel();
    let kernel = match args.precision.tolerance {
        Some(pixels) => {
            let over = Over::of(accel, &args.machine.plan());
            Kernel::Chosen(precision::choose(&scene, &view, size, pixels, over), over, pixels)
        }
        None => Kernel::Asked(args.precision.method()),
    };
    let plan = Plan { method: kernel.method(), ..args.machine.plan() };
    let world = World::build_with(scene, accel, plan, threads)?;

    if own_view.is_none() && !args.quiet {
        ui::say(&format!("camera: {}", report::flags(&view)));
    }
    if args.verbose {
        ui::say(&report::built(&world));
    }
    let job = Job {
        size,
        crop: args.picture.crop,
        view,
        lights: if args.shading.light.is_empty() { own_lights } else { args.shading.light.clone() },
        background: args.shading.background.or(own_background).unwrap_or(BACKGROUND),
        integrator: args.shading.integrator.into(),
        samples: args.picture.spp,
        depth: args.shading.depth,
        shadows: !args.shading.no_shadows,
        relaxed: args.shading.relaxed,
        exec: world.exec(exec),
        threads,
    };
    let progress = ui::Progress::new(args.progress, args.quiet);
    let made = keep.render(&world, &job, progress, &interrupt, args.quiet)?;

    output.write(&output::picture(made.film, format, &name, &job)?)?;
    keep.complete()?;
    let rendered = Rendered {
        name: &name,
        output: &args.output.path,
        world: &world,
        job: &job,
        kernel: &kernel,
        made: made.report,
    };
    if args.verbose {
        rendered.details().iter().for_each(|line| ui::say(line));
    }
    if !args.quiet {
        ui::say(&rendered.line());
    }
    match stats {
        Some(stats) => stats.write(output::json(&rendered.json(stated)).as_bytes()),
        None => Ok(()),
    }
}

/// The size in the flags, the scene's, or 512 by 512.
pub(crate) fn picture_size(args: &PictureArgs, own: Option<&View>) -> (u32, u32) {
    args.size.or(own.and_then(|view| view.size)).unwrap_or(SIZE)
}

/// The scene's view or a fitted one, as far as the flags say nothing else.
fn view(args: &PictureArgs, own: Option<View>, bounds: &Aabb, size: (u32, u32)) -> View {
    let fov = args.fov.unwrap_or(FOV);
    let fitted = || fitted_view(bounds, size, args.up.unwrap_or(Vec3::Y), fov);
    let base = own.unwrap_or_else(fitted);
    View {
        eye: args.eye.unwrap_or(base.eye),
        target: args.target.unwrap_or(base.target),
        up: args.up.unwrap_or(base.up),
        fov_y: args.fov.unwrap_or(base.fov_y),
        size: None,
    }
}

/// The camera of scenes that have none.
pub(crate) fn default_view(bounds: &Aabb, size: (u32, u32)) -> View {
    fitted_view(bounds, size, Vec3::Y, FOV)
}
