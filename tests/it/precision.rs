//! The table of errors bounds what rays find, and the triangle test that it chooses makes a picture
//! within the tolerance.

use glam::{DVec2, DVec3, Vec3};
use rt_kernels::camera::Pinhole;
use rt_kernels::geom::Triangle;
use rt_kernels::tri::Method;
use rt_kernels::{Brute, Bvh, Exec, Plan, Primitives, Ray, Rays, Sequential};
use rt_render::precision::{Choice, ERRORS, Facts, Over, Prediction, choose, predict};
use rt_render::{bounds, fitted_view};
use rt_scene::{Scene, View, spd};
use rt_tests::hash::fnv1a;
use rt_tests::oracle::plane;
use rt_tests::random::{Random, power};
use rt_tests::scenes::{bumpy, far, near, room, slivers};
use rt_tests::trace::closest;
use rt_tests::{aim, rays};

/// A triangle of one of the kinds that are hard to judge, and the eye.
fn hard(kind: usize, random: &mut Random) -> (Vec3, [Vec3; 3]) {
    let [mut a, mut b, mut c] = [(); 3].map(|()| random.in_cube());
    let mut eye = random.direction() * (2.0 + 3.0 * random.unit() as f32);
    match kind {
        // As it comes.
        0 => {}
        // Far from the origin, eye and all.
        1 => {
            let place = random.direction() * random.magnitude(8, 19);
            [a, b, c, eye] = [a, b, c, eye].map(|v| v + place);
        }
        // A needle, whose short edge is any of the three.
        2 => {
            b = a + random.in_cube() * random.magnitude(-14, -2);
            match random.below(3) {
                0 => {}
                1 => (a, b, c) = (c, a, b),
                _ => (a, b, c) = (b, c, a),
            }
        }
        // All corners nearly in line.
        3 => {
            c = aim::between(a, b, random.unit()) + random.in_cube() * random.magnitude(-14, -2);
        }
        // The eye next to a corner.
        4 => {
            eye = random.pick(&[a, b, c]) + random.direction() * random.magnitude(-10, -4).abs();
        }
        // The eye nearly in line with an edge, or nearly in the plane.
        _ => {
            let t = 2.0 + 3.0 * random.unit();
            eye = aim::between(a, b, t) + random.in_cube() * random.magnitude(-12, -3);
        }
    }
    (eye, [a, b, c])
}

const KINDS: usize = 6;

/// What the program foretells of a triangle that is alone in the world.
fn foretold(eye: Vec3, corners: [Vec3; 3]) -> [Prediction; ERRORS.len()] {
    let mut scene = Scene::default();
    scene.mesh.positions = corners.to_vec();
    let triangle = rt_scene::Triangle { position: [0, 1, 2], normal: None, uv: None, material: 0 };
    scene.mesh.triangles = vec![triangle];
    let middle = (corners[0] + corners[1] + corners[2]) / 3.0;
    let view = View { eye, target: middle, up: Vec3::Y, fov_y: 40.0, size: None };
    predict(&scene, &view, (100, 100))
}

/// How far from an edge each ray that is misjudged passes at most, how far from where it is the
/// plane is found, and the greater of both in pixels: measured against `f64`, in units of what is
/// foretold.
fn worst(method: Method, kind: usize, seed: u64) -> [f64; 3] {
    let exec = Exec::best().expect("a level");
    let mut random = Random::new(seed);
    let mut worst = [0.0f64; 3];
    let pixels_at_1 = 50.0 / 20f64.to_radians().tan();
    for _ in 0..rays(1_500) {
        let (eye, corners) = hard(kind, &mut random);
        let foretold = foretold(eye, corners);
        let foretold = foretold.iter().find(|p| p.method == method).expect("all are foretold");
        let scene = Primitives { triangles: vec![Triangle { corners }], ..Primitives::default() };
        let brute = Brute::build_with(&scene, method).expect("in range");
        let aimed: Rays = (0..64).map(|_| aim::at(eye, near_edge(corners, &mut random))).collect();
        for (i, hit) in closest(&brute, exec, &aimed).into_iter().enumerate() {
            let ray = aimed.get(i);
            let Some(meeting) = plane(&ray, corners) else { continue };
            // Aimed past the triangle, a ray may look away from it, which is not in question.
            if meeting.t <= 0.0 && hit.is_none() {
                continue;
            }
            let reach = corners.map(|corner| corner.as_dvec3().distance(eye.as_dvec3()));
            let outside = meeting.outside * reach.into_iter().fold(0.0, f64::max);
            let length = ray.dir.as_dvec3().length();
            let shift = if hit.is_some() != (outside <= 0.0) {
                worst[0] = worst[0].max(outside.abs() / foretold.band);
                outside.abs()
            } else if let Some(hit) = hit {
                let shift = (f64::from(hit.t) - meeting.t).abs() * length * meeting.cosine;
                worst[1] = worst[1].max(shift / foretold.depth);
                shift
            } else {
                continue;
            };
            let pixels = shift / (meeting.t * length) * pixels_at_1;
            worst[2] = worst[2].max(pixels / foretold.pixels);
        }
    }
    worst
}

/// A point on an edge or a corner, or a little beside.
fn near_edge(corners: [Vec3; 3], random: &mut Random) -> Vec3 {
    let i = random.below(3);
    let (a, b) = (corners[i], corners[(i + 1) % 3]);
    let on = if random.below(4) == 0 { a } else { aim::between(a, b, random.unit()) };
    let size = (a - b).abs().max_element();
    match random.below(3) {
        0 => on,
        _ => on + random.in_cube() * size * power(-(random.below(22) as i32)),
    }
}

#[test]
fn no_ray_is_misjudged_by_more_than_foretold() {
    for method in Method::ALL {
        let mut greatest = [0.0f64; 3];
        for kind in 0..KINDS {
            let worst = worst(method, kind, kind as u64);
            assert!(worst.iter().all(|x| *x <= 1.0), "{method:?}, {kind}: {worst:?} of 1");
            greatest = std::array::from_fn(|i| greatest[i].max(worst[i]));
        }
        // A bound that is never neared says nothing.
        assert!(greatest.iter().all(|worst| *worst > 0.02), "{method:?}: only {greatest:?} of 1");
    }
}

const SIZE: (u32, u32) = (200, 150);

fn view(scene: &Scene) -> View {
    scene.view.unwrap_or_else(|| fitted_view(&bounds(scene), SIZE, Vec3::Y, 40.0))
}

fn chosen(scene: &Scene, tolerance: f64) -> Choice {
    chosen_over(Over::SkipArray, scene, tolerance)
}

fn chosen_over(over: Over, scene: &Scene, tolerance: f64) -> Choice {
    choose(scene, &view(scene), SIZE, tolerance, over)
}

#[test]
fn scenes_differ_in_what_they_need() {
    let pick = |scene: &Scene, tolerance| chosen(scene, tolerance).method;
    assert_eq!(pick(&near(), 0.25), Method::Wald);
    assert_eq!(pick(&far(), 0.25), Method::MollerTrumbore);
    assert_eq!(pick(&slivers(), 0.25), Method::Watertight);
    for scene in [near(), far(), slivers(), room(), bumpy()] {
        assert_eq!(pick(&scene, 0.0), Method::Watertight, "{}", scene.name);
    }
    for scene in [near(), far(), bumpy()] {
        assert_eq!(pick(&scene, 1e9), Method::Wald, "{}", scene.name);
    }
    // What is precise enough does not pay where a ray meets many.
    assert_eq!(pick(&slivers(), 1e9), Method::Watertight);
    // The more is allowed, the cheaper it gets, and never dearer.
    let rank = |choice: Choice| {
        choice.predictions.iter().position(|p| p.method == choice.method).expect("one of them")
    };
    for scene in [near(), far(), slivers()] {
        let ranks: Vec<_> = (-30..10).map(|e| rank(chosen(&scene, power(e).into()))).collect();
        assert!(ranks.is_sorted_by(|a, b| a >= b), "{}: {ranks:?}", scene.name);
    }
}

/// Where there is but one test, or the default is the cheapest, a tolerance changes nothing.
#[test]
fn structures_differ_in_what_is_cheap() {
    for scene in [near(), far(), slivers(), room(), bumpy()] {
        for over in [Over::WideNodes, Over::Other] {
            let choice = chosen_over(over, &scene, 1e9);
            assert_eq!(choice.method, Method::Watertight, "{over:?}, {}", scene.name);
        }
    }
}

/// Wald's records cost more memory than they save time, once there are many.
#[test]
fn large_scenes_do_without_larger_records() {
    let near = |size| spd::generate("near", Some(size)).expect("a size that it has");
    let [less, more] = [near(36), near(37)];
    let triangles = [&less, &more].map(|scene| scene.mesh.triangles.len());
    assert!(triangles[0] <= 1 << 14 && triangles[1] > 1 << 14, "{triangles:?}");
    assert_eq!(chosen(&less, 1e9).method, Method::Wald);
    assert_eq!(chosen(&more, 1e9).method, Method::MollerTrumbore);
}

/// To the last bit, once for all architectures: so the choice is the same too.
#[test]
fn what_is_foretold_is_golden() {
    let mut bytes = Vec::new();
    for scene in [near(), far(), room(), bumpy()] {
        for Prediction { band, depth, pixels, .. } in chosen(&scene, 1.0).predictions {
            bytes.extend([band, depth, pixels].iter().flat_map(|x| x.to_bits().to_le_bytes()));
        }
        let facts = Facts::of(&scene);
        let numbers = [facts.smallest_feature, facts.worst_aspect].into_iter().flatten();
        let numbers = numbers.chain([facts.largest_coordinate, facts.boxes_met]);
        bytes.extend(numbers.flat_map(|x| x.to_bits().to_le_bytes()));
    }
    assert_eq!(format!("{:016x}", fnv1a(bytes)), "7f75260c1bb44c44");
}

/// A camera in `f64`, by its own arithmetic.
struct Eye {
    eye: DVec3,
    axes: [DVec3; 3],
    /// Pixels for each unit at distance 1.
    pixels: f64,
}

impl Eye {
    fn new(view: &View) -> Eye {
        let eye = view.eye.as_dvec3();
        let forward = (view.target.as_dvec3() - eye).normalize();
        let right = forward.cross(view.up.as_dvec3()).normalize();
        let half = (f64::from(view.fov_y).to_radians() / 2.0).tan();
        let pixels = f64::from(SIZE.1) / 2.0 / half;
        Eye { eye, axes: [right, right.cross(forward), forward], pixels }
    }

    /// Where a point is seen, in pixels from the middle of the picture.
    fn project(&self, point: DVec3) -> DVec2 {
        let [x, y, z] = self.axes.map(|axis| axis.dot(point - self.eye));
        DVec2::new(x, y) / z * self.pixels
    }

    /// How far from the nearest edge of a triangle a direction is seen, in pixels.
    fn edge_distance(&self, dir: DVec3, corners: [Vec3; 3]) -> f64 {
        let at = self.project(self.eye + dir);
        let [a, b, c] = corners.map(|corner| self.project(corner.as_dvec3()));
        let distance = |a: DVec2, b: DVec2| {
            let edge = b - a;
            let along = ((at - a).dot(edge) / edge.length_squared()).clamp(0.0, 1.0);
            at.distance(a + edge * along)
        };
        distance(a, b).min(distance(b, c)).min(distance(c, a))
    }
}

/// How many rays of a picture find something else than the watertight test, and by how many pixels
/// at most: a ray that finds another triangle is off by its distance from the nearest edge of the
/// triangle that it lost, or found; one that finds the same elsewhere, by the shift of the plane,
/// as it is seen at that distance.
fn off(scene: &Scene, method: Method) -> (usize, f64) {
    let corners = |t: &rt_scene::Triangle| t.position.map(|i| scene.mesh.positions[i as usize]);
    let triangles: Vec<_> =
        scene.mesh.triangles.iter().map(|t| Triangle { corners: corners(t) }).collect();
    let primitives = Primitives { triangles, ..Primitives::default() };
    let view = view(scene);
    let camera = Pinhole::new(
        view.eye,
        view.target,
        view.up,
        (view.fov_y.to_radians() / 2.0).tan(),
        SIZE.0,
        SIZE.1,
    )
    .expect("a camera");
    let pixels = (0..SIZE.1).flat_map(|y| (0..SIZE.0).map(move |x| (x, y)));
    let rays: Rays = pixels.map(|(x, y)| camera.ray(x as f32 + 0.5, y as f32 + 0.5)).collect();
    let find = |method| {
        let bvh = Bvh::build_with(&primitives, Plan { method, ..Plan::default() }, &Sequential)
            .expect("in range");
        closest(&bvh, Exec::best().expect("a level"), &rays)
    };
    let eye = Eye::new(&view);
    let (mut differing, mut worst) = (0, 0.0f64);
    for (i, (want, got)) in find(Method::Watertight).into_iter().zip(find(method)).enumerate() {
        let Ray { dir, .. } = rays.get(i);
        let dir = dir.as_dvec3();
        let of = |prim: u32| primitives.triangles[prim as usize].corners;
        worst = worst.max(match (want, got) {
            (Some(want), Some(got)) if want.prim == got.prim => {
                let meeting = plane(&rays.get(i), of(want.prim)).expect("it was met");
                let shift = f64::from((want.t - got.t).abs()) * meeting.cosine;
                shift / f64::from(want.t) * eye.pixels
            }
            (None, None) => continue,
            _ => {
                differing += 1;
                let either = [want, got].into_iter().flatten();
                let off = either.map(|hit| eye.edge_distance(dir, of(hit.prim)));
                off.fold(f64::INFINITY, f64::min)
            }
        });
    }
    (differing, worst)
}

#[test]
fn pictures_are_within_the_tolerance() {
    let mut seen = 0;
    for scene in [near(), far(), slivers()] {
        for Prediction { method, pixels, .. } in chosen(&scene, 0.0).predictions {
            let (differing, worst) = off(&scene, method);
            assert!(worst <= pixels, "{}, {method:?}: off by {worst}, not {pixels}", scene.name);
            seen += differing;
        }
        for tolerance in [1e-3, 0.25, 16.0, 1e9] {
            let choice = chosen(&scene, tolerance);
            let within = choice.prediction().pixels < tolerance;
            assert!(within || choice.method == Method::Watertight, "{choice:?}");
        }
    }
    assert!(seen > 100, "only {seen} rays differ: nothing was tested");
}

/// The choice matters: what is passed over would have shown.
#[test]
fn what_is_not_chosen_would_show() {
    let (differing, worst) = off(&far(), Method::Wald);
    assert!(differing > 10 && worst > 0.25, "{differing} rays, {worst} px");
}
