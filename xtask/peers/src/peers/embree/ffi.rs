//! As much of Embree's C interface as the comparison needs, of versions 3 and 4: the only `unsafe`
//! file of this package. What it exports is safe.

use std::ffi::{CString, c_char, c_int, c_uint, c_void};
use std::mem::size_of;
use std::path::Path;
use std::ptr;
use std::sync::atomic::{AtomicIsize, Ordering};

use libloading::Library as Shared;
use rt_kernels::Ray as Query;

use crate::clock::{Took, took};

/// An object of Embree's.
type Object = *mut c_void;

type NewDevice = unsafe extern "C" fn(*const c_char) -> Object;
type Release = unsafe extern "C" fn(Object);
type GetProperty = unsafe extern "C" fn(Object, c_int) -> isize;
type GetError = unsafe extern "C" fn(Object) -> c_int;
type Monitor = unsafe extern "C" fn(*mut c_void, isize, bool) -> bool;
type SetMonitor = unsafe extern "C" fn(Object, Monitor, *mut c_void);
type NewOf = unsafe extern "C" fn(Object) -> Object;
type NewGeometry = unsafe extern "C" fn(Object, c_int) -> Object;
type SetInt = unsafe extern "C" fn(Object, c_int);
/// Type, slot, format, stride and count.
type NewBuffer = unsafe extern "C" fn(Object, c_int, c_uint, c_int, usize, usize) -> *mut c_void;
type Attach = unsafe extern "C" fn(Object, Object) -> c_uint;

const GEOMETRY_TYPE_TRIANGLE: c_int = 0;
const BUFFER_TYPE_INDEX: c_int = 0;
const BUFFER_TYPE_VERTEX: c_int = 1;
const FORMAT_UINT3: c_int = 0x5003;
const FORMAT_FLOAT3: c_int = 0x9003;
const SCENE_FLAG_ROBUST: c_int = 1 << 2;
const DEVICE_PROPERTY_VERSION: c_int = 0;
/// Of packets of 4; those of 8 and 16 follow.
const DEVICE_PROPERTY_NATIVE_RAY4_SUPPORTED: c_int = 32;
const INVALID_ID: u32 = u32::MAX;

/// A ray, packets of one, four, eight or sixteen: the fields are in the same order for all.
#[derive(Clone, Copy)]
#[repr(C)]
pub(super) struct Rays<A, const N: usize> {
    align: [A; 0],
    origin: [[f32; N]; 3],
    tnear: [f32; N],
    dir: [[f32; N]; 3],
    time: [f32; N],
    tfar: [f32; N],
    mask: [u32; N],
    id: [u32; N],
    flags: [u32; N],
}

/// What they hit.
#[derive(Clone, Copy)]
#[repr(C)]
pub(super) struct Hits<A, const N: usize> {
    align: [A; 0],
    normal: [[f32; N]; 3],
    uv: [[f32; N]; 2],
    prim: [u32; N],
    geom: [u32; N],
    instance: [u32; N],
    /// Since version 4.2; before it nothing is written there.
    instance_prim: [u32; N],
}

/// Both.
#[derive(Clone, Copy)]
#[repr(C)]
pub(super) struct RayHits<A, const N: usize> {
    rays: Rays<A, N>,
    hits: Hits<A, N>,
}

/// Aligned to as many bytes.
#[derive(Clone, Copy)]
#[repr(align(16))]
pub(super) struct Align16;

/// Aligned to as many bytes.
#[derive(Clone, Copy)]
#[repr(align(32))]
pub(super) struct Align32;

/// Aligned to as many bytes.
#[derive(Clone, Copy)]
#[repr(align(64))]
pub(super) struct Align64;

const _: () = {
    assert!(size_of::<Rays<Align16, 1>>() == 48);
    assert!(size_of::<RayHits<Align16, 1>>() == 96);
    assert!(size_of::<RayHits<Align16, 4>>() == 336);
    assert!(size_of::<RayHits<Align32, 8>>() == 672);
    assert!(size_of::<RayHits<Align64, 16>>() == 1344);
};

impl<A, const N: usize> Rays<A, N> {
    /// These rays, at most as many as there is room for; in the rest are copies of the first.
    fn new(rays: &[Query]) -> Self {
        let ray = |i: usize| rays.get(i).unwrap_or(&rays[0]);
        let each = |component: fn(&Query) -> f32| std::array::from_fn(|i| component(ray(i)));
        Rays {
            align: [],
            origin: [each(|r| r.origin.x), each(|r| r.origin.y), each(|r| r.origin.z)],
            tnear: each(|r| r.tmin),
            dir: [each(|r| r.dir.x), each(|r| r.dir.y), each(|r| r.dir.z)],
            time: [0.0; N],
            tfar: each(|r| r.tmax),
            mask: [u32::MAX; N],
            id: [0; N],
            flags: [0; N],
        }
    }

    fn reset(&mut self, rays: &[Query]) {
        for (tfar, ray) in self.tfar.iter_mut().zip(rays) {
            *tfar = ray.tmax;
        }
    }
}

/// What is handed to Embree, and overwritten by it.
pub(super) trait Record: Copy {
    /// The number of rays.
    const LANES: usize;
    /// Whether the hit is found, not only that there is one.
    const CLOSEST: bool;

    /// These rays, before they are traced.
    fn new(rays: &[Query]) -> Self;

    /// The state before the rays were traced.
    fn reset(&mut self, rays: &[Query]);

    /// `t` and primitive of a ray's hit. If it is not found, only that there is one, both are 0.
    fn hit(&self, lane: usize) -> Option<(f32, u32)>;
}

impl<A: Copy, const N: usize> Record for RayHits<A, N> {
    const LANES: usize = N;
    const CLOSEST: bool = true;

    fn new(rays: &[Query]) -> Self {
        let none = [INVALID_ID; N];
        let hits = Hits {
            align: [],
            normal: [[0.0; N]; 3],
            uv: [[0.0; N]; 2],
            prim: none,
            geom: none,
            instance: none,
            instance_prim: none,
        };
        RayHits { rays: Rays::new(rays), hits }
    }

    fn reset(&mut self, rays: &[Query]) {
        self.rays.reset(rays);
        self.hits.geom = [INVALID_ID; N];
    }

    fn hit(&self, lane: usize) -> Option<(f32, u32)> {
        let found = self.hits.geom[lane] != INVALID_ID;
        found.then(|| (self.rays.tfar[lane], self.hits.prim[lane]))
    }
}

impl<A: Copy, const N: usize> Record for Rays<A, N> {
    const LANES: usize = N;
    const CLOSEST: bool = false;

    fn new(rays: &[Query]) -> Self {
        Rays::new(rays)
    }

    fn reset(&mut self, rays: &[Query]) {
        Rays::reset(self, rays);
    }

    fn hit(&self, lane: usize) -> Option<(f32, u32)> {
        (self.tfar[lane] == f32::NEG_INFINITY).then_some((0.0, 0))
    }
}

/// `RTCIntersectArguments` and `RTCOccludedArguments` of version 4, which are alike.
#[repr(C)]
struct Arguments {
    flags: c_uint,
    feature_mask: c_uint,
    context: *mut c_void,
    filter: *mut c_void,
    callback: *mut c_void,
}

/// `RTCIntersectContext` of version 3.
#[repr(C)]
struct Context {
    flags: c_uint,
    filter: *mut c_void,
    instance: c_uint,
}

type One4 = unsafe extern "C" fn(Object, *mut c_void, *mut Arguments);
type Many4 = unsafe extern "C" fn(*const c_int, Object, *mut c_void, *mut Arguments);
type One3 = unsafe extern "C" fn(Object, *mut Context, *mut c_void);
type Many3 = unsafe extern "C" fn(*const c_int, Object, *mut Context, *mut c_void);

/// An entry that traces.
#[derive(Clone, Copy)]
enum Entry {
    One4(One4),
    Many4(Many4),
    One3(One3),
    Many3(Many3),
}

/// The library.
pub(super) struct Library {
    /// 3 or 4.
    pub(super) major: u32,
    new_device: NewDevice,
    release_device: Release,
    get_property: GetProperty,
    get_error: GetError,
    set_monitor: SetMonitor,
    new_scene: NewOf,
    release_scene: Release,
    set_flags: SetInt,
    set_quality: SetInt,
    commit_scene: Release,
    new_geometry: NewGeometry,
    release_geometry: Release,
    new_buffer: NewBuffer,
    commit_geometry: Release,
    attach: Attach,
    /// Closest hits, by the logarithm of the lanes: 1, (2), 4, 8, 16.
    intersect: [Option<Entry>; 5],
    /// Any hits.
    occluded: [Option<Entry>; 5],
}

/// An entry of a shared library by its name.
///
/// # Safety
/// `T` must be the type of the function of that name.
unsafe fn get<T: Copy>(shared: &Shared, name: &str) -> Result<T, String> {
    // SAFETY: the caller vouches for the type.
    let symbol = unsafe { shared.get::<T>(name.as_bytes()) };
    symbol.map(|symbol| *symbol).map_err(|error| format!("{name}: {error}"))
}

impl Library {
    /// Loads it, for good: it may have threads of its own.
    pub(super) fn open(path: &Path) -> Result<&'static Library, String> {
        // SAFETY: loading Embree runs constructors that ask nothing of the program.
        let shared = unsafe { Shared::new(path) }.map_err(|error| error.to_string())?;
        let s: &'static Shared = Box::leak(Box::new(shared));
        // SAFETY: these are the types that Embree's headers, versions 3 and 4, give to these names;
        // those which differ between the two are chosen by the version that the library states.
        unsafe {
            let (new_device, release_device, get_property) = (
                get::<NewDevice>(s, "rtcNewDevice")?,
                get::<Release>(s, "rtcReleaseDevice")?,
                get::<GetProperty>(s, "rtcGetDeviceProperty")?,
            );
            let device = new_device(c"threads=1".as_ptr());
            let version = get_property(device, DEVICE_PROPERTY_VERSION);
            release_device(device);
            let major = (version / 10_000) as u32;
            if ![3, 4].contains(&major) {
                return Err(format!("{}: Embree {version} is neither 3 nor 4", path.display()));
            }
            let entries = |name: &str| -> Result<[Option<Entry>; 5], String> {
                let mut entries = [None; 5];
                for (lanes, log) in [(1, 0), (4, 2), (8, 3), (16, 4)] {
                    let name = format!("{name}{lanes}");
                    entries[log] = Some(match (major, lanes) {
                        (3, 1) => Entry::One3(get(s, &name)?),
                        (3, _) => Entry::Many3(get(s, &name)?),
                        (_, 1) => Entry::One4(get(s, &name)?),
                        _ => Entry::Many4(get(s, &name)?),
                    });
                }
                Ok(entries)
            };
            let library = Library {
                major,
                new_device,
                release_device,
                get_property,
                get_error: get(s, "rtcGetDeviceError")?,
                set_monitor: get(s, "rtcSetDeviceMemoryMonitorFunction")?,
                new_scene: get(s, "rtcNewScene")?,
                release_scene: get(s, "rtcReleaseScene")?,
                set_flags: get(s, "rtcSetSceneFlags")?,
                set_quality: get(s, "rtcSetSceneBuildQuality")?,
                commit_scene: get(s, "rtcCommitScene")?,
                new_geometry: get(s, "rtcNewGeometry")?,
                release_geometry: get(s, "rtcReleaseGeometry")?,
                new_buffer: get(s, "rtcSetNewGeometryBuffer")?,
                commit_geometry: get(s, "rtcCommitGeometry")?,
                attach: get(s, "rtcAttachGeometry")?,
                intersect: entries("rtcIntersect")?,
                occluded: entries("rtcOccluded")?,
            };
            Ok(Box::leak(Box::new(library)))
        }
    }
}

/// Which lanes of a packet are traced: -1, the others 0.
#[repr(C)]
struct Valid {
    align: [Align64; 0],
    lanes: [c_int; 16],
}

/// What a scene is to be built for.
#[derive(Clone, Debug)]
pub(super) struct Config {
    /// `isa` of the device, as Embree names it; `None` for the best.
    pub(super) isa: Option<&'static str>,
    pub(super) threads: usize,
    pub(super) robust: bool,
    /// 1 is medium, 2 is high.
    pub(super) quality: i32,
}

/// Triangles, ready to be traced.
pub(super) struct Scene {
    library: &'static Library,
    device: Object,
    scene: Object,
    /// Bytes that Embree holds, less what it has freed.
    memory: Box<AtomicIsize>,
    /// How long the commit took.
    pub(super) build: Took,
    /// What the scene added to its memory, with the buffers that it must keep.
    pub(super) bytes: isize,
    /// Whether packets of 1, 2, 4, 8 and 16 are native to the device.
    pub(super) native: [bool; 5],
}

/// Counts what Embree takes and gives back.
unsafe extern "C" fn monitor(count: *mut c_void, bytes: isize, _post: bool) -> bool {
    // SAFETY: it is the counter that `Scene::build` registers, which outlives the device.
    let count = unsafe { &*count.cast::<AtomicIsize>() };
    count.fetch_add(bytes, Ordering::Relaxed);
    true
}

impl Scene {
    /// Builds the hierarchy of a mesh.
    pub(super) fn build(
        library: &'static Library,
        config: &Config,
        vertices: &[[f32; 3]],
        triangles: &[[u32; 3]],
    ) -> Result<Scene, String> {
        if triangles.as_flattened().iter().any(|&i| i as usize >= vertices.len()) {
            return Err("a corner has no vertex".to_owned());
        }
        let l = library;
        let isa = config.isa.map_or(String::new(), |isa| format!("isa={isa},"));
        let text = format!("{isa}threads={}", config.threads);
        let text = CString::new(text).map_err(|error| error.to_string())?;
        let memory = Box::new(AtomicIsize::new(0));
        // SAFETY: the calls are in the order that Embree asks for. The scene keeps the geometry,
        // which keeps its buffers; each buffer is as long as it is asked to be, and filled before
        // it is committed; all corners are vertices. The counter is on the heap and dropped after
        // the device. If one of these calls fails, the error is fetched and the scene given up.
        unsafe {
            let device = (l.new_device)(text.as_ptr());
            if device.is_null() {
                return Err(format!("no device: error {}", (l.get_error)(ptr::null_mut())));
            }
            let count = (&raw const *memory).cast_mut().cast();
            (l.set_monitor)(device, monitor, count);
            let mut native = [true, false, false, false, false];
            for log in 2..5 {
                let property = DEVICE_PROPERTY_NATIVE_RAY4_SUPPORTED + log - 2;
                native[log as usize] = (l.get_property)(device, property) != 0;
            }
            let before = memory.load(Ordering::Relaxed);
            let scene = (l.new_scene)(device);
            let mut built =
                Scene { library, device, scene, memory, build: Took::default(), bytes: 0, native };
            (l.set_flags)(scene, if config.robust { SCENE_FLAG_ROBUST } else { 0 });
            (l.set_quality)(scene, config.quality);
            let geometry = (l.new_geometry)(device, GEOMETRY_TYPE_TRIANGLE);
            let buffer = |kind, format, items: &[[u32; 3]]| {
                let stride = size_of::<[u32; 3]>();
                let to = (l.new_buffer)(geometry, kind, 0, format, stride, items.len());
                if !to.is_null() {
                    ptr::copy_nonoverlapping(items.as_ptr(), to.cast(), items.len());
                }
            };
            let bits: Vec<_> = vertices.iter().map(|vertex| vertex.map(f32::to_bits)).collect();
            buffer(BUFFER_TYPE_VERTEX, FORMAT_FLOAT3, &bits);
            buffer(BUFFER_TYPE_INDEX, FORMAT_UINT3, triangles);
            (l.commit_geometry)(geometry);
            (l.attach)(scene, geometry);
            (l.release_geometry)(geometry);
            ((), built.build) = took(|| (l.commit_scene)(scene));
            built.bytes = built.memory.load(Ordering::Relaxed) - before;
            match (l.get_error)(device) {
                0 => Ok(built),
                error => Err(format!("Embree's error {error}")),
            }
        }
    }

    /// Traces all records; those beyond `rays` in the last one are left out.
    pub(super) fn trace<R: Record>(&self, records: &mut [R], rays: usize, coherent: bool) {
        let entries = if R::CLOSEST { &self.library.intersect } else { &self.library.occluded };
        let Some(entry) = entries[R::LANES.ilog2() as usize] else { return };
        let mut valid = Valid { align: [], lanes: [-1; 16] };
        let coherent = c_uint::from(coherent);
        // Those of triangles.
        let feature_mask = 1 << 1;
        let null = ptr::null_mut();
        let mut arguments = Arguments {
            flags: coherent << 16,
            feature_mask,
            context: null,
            filter: null,
            callback: null,
        };
        let mut context = Context { flags: coherent, filter: null, instance: INVALID_ID };
        let whole = rays / R::LANES;
        let (full, rest) = records.split_at_mut(whole.min(records.len()));
        for (records, active) in [(full, R::LANES), (rest, rays % R::LANES)] {
            valid.lanes[active..].fill(0);
            let valid = valid.lanes.as_ptr();
            for record in records {
                let record = (&raw mut *record).cast();
                // SAFETY: the entry is of this library's version and for records of this size,
                // alignment and kind. `valid` has at least as many numbers as there are lanes.
                unsafe {
                    match entry {
                        Entry::One4(call) => call(self.scene, record, &mut arguments),
                        Entry::Many4(call) => call(valid, self.scene, record, &mut arguments),
                        Entry::One3(call) => call(self.scene, &mut context, record),
                        Entry::Many3(call) => call(valid, self.scene, &mut context, record),
                    }
                }
            }
        }
    }
}

impl Drop for Scene {
    fn drop(&mut self) {
        // SAFETY: both are alive, and nobody else has them.
        unsafe {
            (self.library.release_scene)(self.scene);
            (self.library.release_device)(self.device);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::Vec3;

    fn ray(i: usize) -> Query {
        let origin = Vec3::new(i as f32, 10.0, 20.0);
        Query { tmin: 0.5, tmax: 30.0 + i as f32, ..Query::new(origin, Vec3::Y) }
    }

    #[test]
    fn a_packet_lies_component_by_component() {
        let rays: Vec<_> = (0..3).map(ray).collect();
        let packet = Rays::<Align16, 4>::new(&rays);
        // The lane without a ray has a copy of the first.
        assert_eq!(packet.origin[0], [0.0, 1.0, 2.0, 0.0]);
        assert_eq!((packet.dir[1], packet.tnear), ([1.0; 4], [0.5; 4]));
        assert_eq!(packet.tfar, [30.0, 31.0, 32.0, 30.0]);
    }

    #[test]
    fn what_embree_writes_is_read_and_restored() {
        let rays: Vec<_> = (0..4).map(ray).collect();
        let mut closest = RayHits::<Align16, 4>::new(&rays);
        assert_eq!(closest.hit(1), None);
        (closest.rays.tfar[1], closest.hits.geom[1], closest.hits.prim[1]) = (2.0, 0, 7);
        assert_eq!(closest.hit(1), Some((2.0, 7)));
        closest.reset(&rays);
        assert_eq!((closest.hit(1), closest.rays.tfar[1]), (None, 31.0));

        let mut any = Rays::<Align16, 4>::new(&rays);
        any.tfar[2] = f32::NEG_INFINITY;
        assert_eq!([any.hit(1), any.hit(2)], [None, Some((0.0, 0))]);
        Record::reset(&mut any, &rays);
        assert_eq!(any.hit(2), None);
    }
}
