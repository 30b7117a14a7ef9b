//! One scene, one picture: on every level, machine, accelerator, packet size and thread count.

use std::fmt::Write;
use std::path::Path;

use glam::Vec3;
use rt_kernels::tri::Method;
use rt_render::{
    AccelKind, Builder, Exec, Film, Integrator, Job, KdBuilder, Layout, Level, Mailbox, Plan,
    Silent, World, fitted_view, render,
};
use rt_scene::Scene;
use rt_tests::hash::fnv1a;
use rt_tests::scenes::{bumpy, glass, room};
use rt_tests::trace::{every_plan, every_way, ways};

/// Neither side is a multiple of the tiles', and no tile is alone.
const SIZE: (u32, u32) = (75, 50);

const INTEGRATORS: [Integrator; 4] =
    [Integrator::Whitted, Integrator::Eyelight, Integrator::Normals, Integrator::Depth];

fn scenes() -> Vec<Scene> {
    let computed = |name: &String| rt_scene::open(name).expect("a scene that is computed");
    let procedures = ["balls:2", "rings:1", "tree:3", "mount:2", "gears:1"];
    let computed = procedures.map(|name| computed(&format!("spd:{name}")));
    [bumpy(), room(), glass()].into_iter().chain(computed).collect()
}

/// The picture of a scene, seen as it says or from in front.
fn job(world: &World, scene: &Scene, integrator: Integrator, exec: Exec) -> Job {
    Job {
        size: SIZE,
        crop: None,
        view: scene.view.unwrap_or_else(|| fitted_view(world.bounds(), SIZE, Vec3::Y, 40.0)),
        lights: scene.lights.clone(),
        background: scene.background.unwrap_or(Vec3::splat(0.1)),
        integrator,
        samples: 1,
        depth: 4,
        shadows: true,
        relaxed: false,
        exec,
        threads: 1,
    }
}

fn world(scene: &Scene, kind: AccelKind, threads: usize) -> World {
    World::build(scene.clone(), kind, threads).expect("a scene that can be rendered")
}

/// All that a film shows, to the last bit.
fn bytes(film: &Film) -> Vec<u8> {
    let channels = film.pixels().iter().flat_map(|pixel| pixel.to_array());
    let exact = channels.flat_map(|channel| channel.to_bits().to_le_bytes());
    exact.chain(film.to_srgb8()).collect()
}

fn picture(world: &World, job: &Job) -> Vec<u8> {
    let (film, _) = render(world, job, &Silent).expect("a job that can be done");
    assert_eq!((film.width(), film.height()), SIZE);
    assert!(film.pixels().iter().all(|pixel| pixel.is_finite()), "a pixel is not finite");
    bytes(&film)
}

#[test]
fn every_way_makes_the_same_picture() {
    let best = Exec::best().expect("a level");
    for scene in scenes() {
        let bvh = world(&scene, AccelKind::Bvh, 1);
        let kd = kd(KdBuilder::default());
        let [brute, cells] = [AccelKind::Brute, kd].map(|kind| world(&scene, kind, 1));
        let threaded = [AccelKind::Bvh, kd].map(|kind| world(&scene, kind, 2));
        for integrator in INTEGRATORS {
            let job = |exec, threads| Job { threads, ..job(&bvh, &scene, integrator, exec) };
            let want = picture(&bvh, &job(best, 1));
            let name = format!("{} {}", scene.name, integrator.name());
            let same = |world: &World, exec, threads| {
                let way = format!("{:?}, {exec:?}, {threads} threads", world.accel_kind());
                assert!(picture(world, &job(exec, threads)) == want, "{name} differs: {way}");
            };
            // The others trace the same rays from the eye, and no more.
            let all = integrator == Integrator::Whitted;
            for exec in if all { ways() } else { vec![best] } {
                same(&bvh, exec, 1);
                same(&cells, exec, 1);
            }
            same(&brute, best, 1);
            for threads in [2, 3] {
                same(&bvh, best, threads);
                threaded.iter().for_each(|world| same(world, best, threads));
            }
        }
    }
}

fn kd(builder: KdBuilder) -> AccelKind {
    AccelKind::Kd { builder, mailbox: Mailbox::default() }
}

#[test]
fn every_builder_makes_the_same_picture() {
    let exec = Exec::best().expect("a level");
    for scene in scenes() {
        let want = world(&scene, AccelKind::Brute, 1);
        let want = picture(&want, &job(&want, &scene, Integrator::Whitted, exec));
        let boxes = Builder::ALL.map(|builder| {
            let plan = Plan { builder, ..Plan::default() };
            (AccelKind::Bvh, plan, builder.name())
        });
        let cells = KdBuilder::ALL.map(|builder| (kd(builder), Plan::default(), builder.name()));
        for (kind, plan, builder) in boxes.into_iter().chain(cells) {
            for threads in [1, 2] {
                let world = World::build_with(scene.clone(), kind, plan, threads)
                    .expect("a scene that can be rendered");
                let job = job(&world, &scene, Integrator::Whitted, exec);
                assert_eq!(world.builder(), Some(builder));
                let same = picture(&world, &job) == want;
                assert!(same, "{} differs: {kind:?}, {threads} threads", scene.name);
            }
        }
    }
}

#[test]
fn every_layout_makes_the_same_picture() {
    let exec = Exec::best().expect("a level");
    for scene in scenes() {
        let want = world(&scene, AccelKind::Brute, 1);
        let want = picture(&want, &job(&want, &scene, Integrator::Whitted, exec));
        for layout in Layout::ALL {
            let plan = Plan { layout, ..Plan::default() };
            let world = World::build_with(scene.clone(), AccelKind::Bvh, plan, 1)
                .expect("a scene that can be rendered");
            assert_eq!(world.layout(), layout.name());
            for level in Level::available() {
                let job = job(&world, &scene, Integrator::Whitted, Exec::at(level));
                let same = picture(&world, &job) == want;
                assert!(same, "{} differs: {}, {level}", scene.name, layout.name());
            }
        }
    }
}

/// Scenes of hundreds of thousands of triangles, where they are there: every builder in every layout,
/// in packets of every size, at every level.
#[test]
#[ignore = "half a minute, and scenes that are not of this repository"]
fn real_scenes_look_the_same_every_way() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../shared/scenes");
    let best = Exec::best().expect("a level");
    let mut seen = 0;
    for name in ["obj/bunny.obj", "obj/conference.obj", "obj/teapot.obj", "spd/gears_s2.nff"] {
        let Ok(scene) = rt_scene::open(folder.join(name)) else { continue };
        let kd = world(&scene, kd(KdBuilder::default()), 1);
        let want = picture(&kd, &job(&kd, &scene, Integrator::Whitted, best));
        for plan in every_plan(Method::default()) {
            let world = World::build_with(scene.clone(), AccelKind::Bvh, plan, 2)
                .expect("a scene that can be rendered");
            for exec in every_way() {
                let job = job(&world, &scene, Integrator::Whitted, exec);
                assert!(picture(&world, &job) == want, "{name} differs: {plan:?}, {exec:?}");
            }
        }
        seen += 1;
    }
    assert!(seen > 0, "no scene in {}", folder.display());
}

/// The file holds what was seen and found good, once for all architectures.
#[test]
fn pictures_are_golden() {
    let exec = Exec::best().expect("a level");
    let mut got = String::new();
    for scene in scenes() {
        let world = world(&scene, AccelKind::Bvh, 1);
        for integrator in INTEGRATORS {
            let hash = fnv1a(picture(&world, &job(&world, &scene, integrator, exec)));
            let name = scene.name.replace(':', "-");
            writeln!(got, "{name}-{} {hash:016x}", integrator.name()).expect("memory");
        }
    }
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("golden/films.txt");
    if std::env::var_os("RT_BLESS").is_some() {
        std::fs::write(&path, &got).expect("golden/films.txt can be written");
    }
    let want = std::fs::read_to_string(&path).unwrap_or_default();
    assert_eq!(got, want, "pictures changed: if they should, `cargo xtask bless`");
}

/// Guards the two tests above: pictures of nothing are all alike.
#[test]
fn pictures_show_something() {
    let exec = Exec::best().expect("a level");
    for scene in scenes() {
        let world = world(&scene, AccelKind::Bvh, 1);
        for integrator in INTEGRATORS {
            let job = job(&world, &scene, integrator, exec);
            let (film, _) = render(&world, &job, &Silent).expect("a job that can be done");
            let mut colors: Vec<_> = film.to_srgb8().chunks(3).map(<[u8]>::to_vec).collect();
            colors.sort();
            colors.dedup();
            let name = integrator.name();
            assert!(colors.len() > 40, "{} {name}: only {} colours", scene.name, colors.len());
        }
    }
}
