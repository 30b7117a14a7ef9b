//! `rt paper shading`.
//!
//! Wald, Slusallek, Benthin and Wagner 2001: what Sections 5 and 6.2 and Figures 3 and 4 say of shading.

use std::path::Path;
use std::time::Duration;

use glam::Vec3;
use rt_render::measure;
use rt_render::{AccelKind, Exec, Film, Integrator, Job, Level, PacketSize, Report, World};
use rt_scene::{Scene, spd};
use serde_json::{Value, json};

use crate::args::{ShadingPaperArgs, best_level};
use crate::cmd::render::default_view;
use crate::error::Error;
use crate::output;

/// The procedural scenes, and a size for the impatient.
const SCENES: [(&str, u32); 11] = [
    ("balls", 2),
    ("gears", 1),
    ("jacks", 1),
    ("lattice", 2),
    ("mount", 2),
    ("rings", 2),
    ("shells", 1),
    ("sombrero", 1),
    ("teapot", 2),
    ("tetra", 3),
    ("tree", 4),
];

/// How often a ray is sent on in a full picture.
const DEPTH: u32 = 5;

/// How much narrower the angle of view is in the close-up.
const ZOOM: f32 = 6.0;

/// Measures one thing after the other; what is done is shown at once.
pub(crate) fn run(args: &ShadingPaperArgs) -> Result<(), Error> {
    let json = args.json.as_deref().map(output::open_json).transpose()?;
    let table = args.json.as_deref() != Some(Path::new("-"));
    let show = |text: &str| if table { output::to_stdout(text.as_bytes()) } else { Ok(()) };
    let mut rows = Vec::new();
    let mut add = |(text, mut new): (String, Vec<Value>)| {
        rows.append(&mut new);
        show(&text)
    };
    add(phong(args)?)?;
    add(texturing(args)?)?;
    add(close_up(args)?)?;
    add((SPEED_HEAD.to_owned(), Vec::new()))?;
    for scene in scenes(args)? {
        add(speed(scene, args)?)?;
    }
    match json {
        Some(json) => json.write(output::json(&json!({ "rows": rows })).as_bytes()),
        None => Ok(()),
    }
}

fn all_threads() -> usize {
    std::thread::available_parallelism().map_or(1, usize::from)
}

fn ms(time: Duration) -> f64 {
    time.as_secs_f64() * 1e3
}

fn fps(report: &Report) -> f64 {
    1.0 / report.total.as_secs_f64()
}

/// A scene, with all that surfaces do on one thread.
fn prepared(mut scene: Scene, args: &ShadingPaperArgs) -> Result<(World, Job), Error> {
    let (view, lights) = (scene.view.take(), scene.lights.clone());
    let background = scene.background.unwrap_or(Vec3::ZERO);
    let world = World::build(scene, AccelKind::Bvh, all_threads())?;
    let job = Job {
        size: args.size,
        crop: None,
        view: view.unwrap_or_else(|| default_view(world.bounds(), args.size)),
        lights,
        background,
        integrator: Integrator::Whitted,
        samples: 1,
        depth: DEPTH,
        shadows: true,
        relaxed: false,
        exec: world.exec(Exec::at(best_level()?)),
        threads: 1,
    };
    Ok((world, job))
}

fn pictures(jobs: &[(&World, Job)], args: &ShadingPaperArgs) -> Result<Vec<(Film, Report)>, Error> {
    Ok(measure::pictures(jobs, args.rounds.into())?)
}

/// Phong's model in lanes, and all of the shading of a picture.
fn phong(args: &ShadingPaperArgs) -> Result<(String, Vec<Value>), Error> {
    let best = best_level()?;
    let one = Exec { level: best, packet: PacketSize::Single };
    let levels = Level::available().flat_map(|level| [false, true].map(|r| (Exec::at(level), r)));
    let ways: Vec<_> = [(one, false)].into_iter().chain(levels).collect();
    let times = measure::phong(&ways, 10 * usize::from(args.rounds));
    let mut rows = Vec::new();
    let mut text = format!(
        "Phong's model for a point and a light (paper, Section 5: 2 to 2.5 times as fast by SSE)\n  \
         {:<18}{:>7}{:>9}{:>9}\n",
        "level", "lanes", "ns", "times"
    );
    for (&(exec, relaxed), time) in ways.iter().zip(&times) {
        let single = exec.packet == PacketSize::Single;
        let (level, lanes) = match single {
            true => ("one", 1),
            false => (exec.level.name(), exec.level.lanes()),
        };
        let (ns, gain) = (time.as_secs_f64() * 1e9, times[0].as_secs_f64() / time.as_secs_f64());
        let way = format!("{level}{}", if relaxed { ", relaxed" } else { "" });
        text += &format!("  {way:<18}{lanes:>7}{ns:>9.2}{gain:>9.2}\n");
        rows.push(json!({
            "what": "phong", "level": level, "lanes": lanes, "relaxed": relaxed, "ns": ns,
        }));
    }

    text += "\nAll shading of a picture: surfaces, materials, lights, rays that are sent on\n";
    text += &format!(
        "  {:<14}{:>11}{:>11}{:>9}{:>19}\n",
        "scene", "scalar ms", "lanes ms", "times", "share of the frame"
    );
    for name in ["balls", "rings", "tree"] {
        let size = args.quick.then_some(2);
        let (world, job) = prepared(spd::generate(name, size)?, args)?;
        let scalar = Job { exec: one, ..job.clone() };
        let made = pictures(&[(&world, scalar), (&world, job)], args)?;
        let [(first, scalar), (second, lanes)] = &made[..] else { unreachable!("two pictures") };
        assert!(first == second, "one answer");
        let [a, b] = [scalar.shading, lanes.shading].map(ms);
        let share = lanes.shading.as_secs_f64() / lanes.total.as_secs_f64();
        let scene = world.name();
        let times = a / b;
        text += &format!("  {scene:<14}{a:>11.1}{b:>11.1}{times:>9.2}{:>17.0} %\n", share * 100.0);
        rows.push(json!({
            "what": "shading", "scene": scene, "scalar_ms": a, "lanes_ms": b, "share": share,
        }));
    }
    Ok((text, rows))
}

/// How often the picture is laid on the terrain along each side: as large as it is seen, and so small
/// that neighbouring pixels find no colours in the same part of memory.
const REPEATS: [u32; 2] = [1, 8];

/// What textures take of a frame.
fn texturing(args: &ShadingPaperArgs) -> Result<(String, Vec<Value>), Error> {
    let triangles = if args.quick { 20_000 } else { 1_000_000 };
    let with = REPEATS.map(|repeats| measure::textured_terrain(triangles, repeats));
    let mut without = with[0].clone();
    without.remove_textures();
    let (plain, job) = prepared(without, args)?;
    let textured = with.map(|scene| prepared(scene, args).map(|(world, _)| world));
    let textured = textured.into_iter().collect::<Result<Vec<_>, _>>()?;
    // As in the paper's figure: what is seen, and its light.
    let job = Job { depth: 0, shadows: false, ..job };
    let jobs: Vec<_> = [&plain].into_iter().chain(&textured).map(|w| (w, job.clone())).collect();
    let made = pictures(&jobs, args)?;
    let (plain, textured) = (&made[0].1, &made[1..]);
    let mut text = format!(
        "\nTextures (paper, Figure 3: less than 10 % of the frame rate)\n  \
         {}, frames a second: {:.1} without\n",
        with_name(triangles),
        fps(plain),
    );
    let mut rows = Vec::new();
    for (repeats, (_, report)) in REPEATS.into_iter().zip(textured) {
        let share = 1.0 - fps(report) / fps(plain);
        text += &format!(
            "  {:.1} with {repeats}x{repeats} pictures of 1024x1024: {:.1} % fewer\n",
            fps(report),
            share * 100.0
        );
        rows.push(json!({
            "what": "texturing", "scene": with_name(triangles), "repeats": repeats,
            "plain_ms": ms(plain.total), "textured_ms": ms(report.total), "share": share,
        }));
    }
    Ok((text, rows))
}

fn with_name(triangles: usize) -> String {
    format!("a terrain of {triangles} triangles")
}

/// A mirror that fills the picture, against all of the scene.
fn close_up(args: &ShadingPaperArgs) -> Result<(String, Vec<Value>), Error> {
    let (world, job) = prepared(spd::generate("balls", args.quick.then_some(2))?, args)?;
    let mut near = job.clone();
    near.view.fov_y /= ZOOM;
    let made = pictures(&[(&world, job), (&world, near)], args)?;
    let mut text = format!(
        "\nA mirror from near by (paper, Figure 4: slower only where it fills the picture)\n  \
         {:<22}{:>9}{:>14}{:>12}{:>15}\n",
        world.name(),
        "frames/s",
        "million rays",
        "reflected",
        "rays/s of all"
    );
    let mut rows = Vec::new();
    for (what, (_, report)) in ["all of it", "six times as near"].into_iter().zip(&made) {
        let rays = report.all().rays as f64;
        let reflected = report.reflection.rays as f64;
        let (frames, speed) = (fps(report), rays / report.total.as_secs_f64() / 1e6);
        text += &format!(
            "  {what:<22}{frames:>9.1}{:>14.2}{:>12.2}{speed:>13.1} M\n",
            rays / 1e6,
            reflected / 1e6
        );
        rows.push(json!({
            "what": "close-up", "view": what, "scene": world.name(), "fps": frames,
            "rays": rays, "reflected": reflected, "mrays_per_s": speed,
        }));
    }
    Ok((text, rows))
}

const SPEED_HEAD: &str = "
Frames a second (paper, Table 4: 0.8 to 1.8 of primary rays, 512x512, Pentium III at 800 MHz, one
thread; Table 5: 2.4 of an office with reflections and shadows, ten such)
                      primary rays alone       shadows, 5 bounces
  scene               1 thread       all       1 thread       all
";

/// The scenes whose frames are counted: procedural ones, and what was named.
fn scenes(args: &ShadingPaperArgs) -> Result<Vec<Scene>, Error> {
    let mut scenes = Vec::new();
    for (name, small) in SCENES {
        scenes.push(spd::generate(name, args.quick.then_some(small))?);
    }
    for name in &args.scenes {
        scenes.push(rt_scene::open(name)?);
    }
    Ok(scenes)
}

fn speed(scene: Scene, args: &ShadingPaperArgs) -> Result<(String, Vec<Value>), Error> {
    let (world, job) = prepared(scene, args)?;
    let primary = Job { depth: 0, shadows: false, ..job.clone() };
    let threads = all_threads();
    let jobs = [
        (&world, primary.clone()),
        (&world, Job { threads, ..primary }),
        (&world, job.clone()),
        (&world, Job { threads, ..job }),
    ];
    let made = pictures(&jobs, args)?;
    let frames: Vec<f64> = made.iter().map(|(_, report)| fps(report)).collect();
    let [a, b, c, d] = frames[..] else { unreachable!("four pictures") };
    let name = world.name();
    let text = format!("  {name:<20}{a:>8.1}{b:>10.1}{c:>15.1}{d:>10.1}\n");
    let row = json!({
        "what": "speed", "scene": name, "threads": threads,
        "primary_fps": a, "primary_fps_all": b, "full_fps": c, "full_fps_all": d,
    });
    Ok((text, vec![row]))
}
