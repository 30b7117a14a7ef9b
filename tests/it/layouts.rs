//! What is wide nodes' own: the nearest child first, ties among lanes, and rays that go together.

use glam::Vec3;
use rt_kernels::geom::{Sphere, Triangle};
use rt_kernels::tri::Method;
use rt_kernels::{Accelerator, Builder, Bvh, Exec, Hits, Layout, PacketSize, Plan};
use rt_kernels::{Primitives, Rays, Sequential, Stats};
use rt_tests::aim;
use rt_tests::trace::closest;
use simd4::Level;

const WIDE: [Layout; 2] = [Layout::Bvh4, Layout::Bvh8];

fn build(scene: &Primitives, builder: Builder, layout: Layout) -> Bvh {
    let plan = Plan { builder, layout, ..Plan::default() };
    Bvh::build_with(scene, plan, &Sequential).expect("in range")
}

/// A triangle across the z axis, about the point there.
fn screen(z: f32) -> Triangle {
    let corners = [[-2.0, -2.0], [3.0, -1.0], [0.0, 3.0]];
    Triangle { corners: corners.map(|[x, y]| Vec3::new(x, y, z)) }
}

/// One ray along the z axis, from in front of all screens or from behind.
fn through(from: f32, to: f32) -> Rays {
    [aim::at(Vec3::Z * from, Vec3::Z * to)].into_iter().collect()
}

/// A row of screens: who goes from near to far and forgets what is behind the first is done with a
/// node on each level and the first leaf or two, from either side.
#[test]
fn the_nearest_come_first_and_the_rest_is_dropped() {
    let n = 1024;
    let triangles = (0..n).map(|i| screen(i as f32)).collect();
    let scene = Primitives { triangles, ..Primitives::default() };
    for layout in WIDE {
        let bvh = build(&scene, Builder::BinnedSah, layout);
        assert!(bvh.nodes() > 30, "{layout:?}: {} nodes", bvh.nodes());
        for (from, to, prim) in [(-9.0, 0.0, 0), (2.0 * n as f32, 0.0, n - 1)] {
            for level in Level::available() {
                let (rays, mut hits, mut stats) =
                    (through(from, to), Hits::new(), Stats::default());
                bvh.closest(Exec::at(level), &rays, &mut hits, &mut stats);
                assert_eq!(hits.get(0).map(|hit| hit.prim), Some(prim));
                let few = stats.node_visits <= bvh.depth() as u64 && stats.triangle_tests <= 16;
                assert!(few, "{layout:?}, {level}: {stats:?}, {} deep", bvh.depth());
            }
        }
    }
}

/// Of the first leaf on the way any hit will do, and it is the last to be looked at: with spheres
/// about the origin each in its own box, which all contain it.
#[test]
fn any_hit_is_enough() {
    let balls = (0..500).map(|i| Sphere { center: Vec3::ZERO, radius: 1.0 + i as f32 });
    let scene = Primitives { spheres: balls.collect(), ..Primitives::default() };
    for layout in WIDE {
        let bvh = build(&scene, Builder::BinnedSah, layout);
        let (mut found, mut any, mut all) = (Vec::new(), Stats::default(), Stats::default());
        let (exec, rays) = (Exec::best().expect("a level"), through(0.0, 1.0));
        bvh.any(exec, &rays, &mut found, &mut any);
        bvh.closest(exec, &rays, &mut Hits::new(), &mut all);
        assert_eq!(found, [true]);
        assert!(any.sphere_tests <= 15 && any.sphere_tests < all.sphere_tests, "{any:?}, {all:?}");
    }
}

/// More of the same triangle than a leaf holds, then of the same sphere, that touches it: the lowest
/// number wins in whichever lane, block and leaf it is.
#[test]
fn equal_distances_go_to_the_lowest_number() {
    let ball = Sphere { center: Vec3::Z, radius: 1.0 };
    let mut triangles: Vec<_> = (0..50).map(|i| screen(9.0 + i as f32)).collect();
    for wins in [0, 1, 5, 23, 49] {
        triangles[wins..].fill(screen(0.0));
        let scene =
            Primitives { triangles: triangles.clone(), spheres: vec![ball; 20], cones: vec![] };
        for builder in Builder::ALL {
            for layout in WIDE {
                let bvh = build(&scene, builder, layout);
                for level in Level::available() {
                    let hits = closest(&bvh, Exec::at(level), &through(-2.0, 0.0));
                    let hit = hits[0].expect("it is in the way");
                    let name = format!("{builder:?}, {layout:?}, {level}");
                    assert_eq!((hit.prim, hit.t), (wins as u32, 1.0), "{name}");
                }
            }
        }
        triangles[wins..].iter_mut().for_each(|triangle| *triangle = screen(70.0));
    }
}

/// Wide nodes are for packets of any size, and the default triangle test.
#[test]
fn a_choice_comes_to_what_there_is() {
    let scene = Primitives { triangles: vec![screen(0.0)], ..Primitives::default() };
    let methods = Method::ALL.into_iter();
    for (method, layout) in methods.flat_map(|method| Layout::ALL.map(|layout| (method, layout))) {
        let plan = Plan { layout, method, ..Plan::default() };
        let bvh = Bvh::build_with(&scene, plan, &Sequential).expect("in range");
        if method != Method::default() {
            assert_eq!(bvh.plan().layout, Layout::Skip, "{plan:?}");
            continue;
        }
        assert_eq!(bvh.plan(), plan);
        for level in Level::available() {
            let eight = match level {
                Level::Scalar(_) => PacketSize::Four,
                _ => PacketSize::Eight,
            };
            let sixteen = if level.lanes() == 16 { PacketSize::Native } else { eight };
            let wide = WIDE.contains(&layout);
            for (packet, skip, large) in [
                (PacketSize::Single, PacketSize::Single, PacketSize::Single),
                (PacketSize::Four, PacketSize::Four, PacketSize::Four),
                (PacketSize::Eight, eight, PacketSize::Eight),
                (PacketSize::Sixteen, sixteen, PacketSize::Sixteen),
                (PacketSize::Native, PacketSize::Native, PacketSize::Large),
                (PacketSize::Large, PacketSize::Native, PacketSize::Large),
            ] {
                let want = if wide { large } else { skip };
                let exec = bvh.exec(Exec { level, packet });
                assert_eq!((exec.level, exec.packet), (level, want), "{plan:?}");
            }
        }
    }
}
