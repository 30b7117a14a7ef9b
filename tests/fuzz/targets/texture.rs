//! Any bytes as the texture of a material, PNG or JPEG.
#![no_main]

libfuzzer_sys::fuzz_target!(|bytes: &[u8]| {
    let obj = b"mtllib a.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 1\nusemtl a\nf 1/1 2/1 3/1\n";
    let mut load = |name: &str| match name {
        "a.mtl" => Ok(b"newmtl a\nmap_Kd a.png\n".to_vec()),
        _ => Ok(bytes.to_vec()),
    };
    rt_fuzz::check(rt_scene::obj::parse(obj, "fuzz.obj", &mut load));
});
