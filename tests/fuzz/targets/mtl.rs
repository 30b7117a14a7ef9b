//! Any bytes as the material library of an OBJ file.
#![no_main]

libfuzzer_sys::fuzz_target!(|bytes: &[u8]| {
    let obj = b"mtllib a.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nusemtl a\nf 1 2 3\nusemtl b\nf 3 2 1\n";
    let mut library = |_: &str| Ok(bytes.to_vec());
    rt_fuzz::check(rt_scene::obj::parse(obj, "fuzz.obj", &mut library));
});
