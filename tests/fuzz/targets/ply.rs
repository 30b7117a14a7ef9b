//! Any bytes as a PLY file.
#![no_main]

libfuzzer_sys::fuzz_target!(|bytes: &[u8]| {
    rt_fuzz::check(rt_scene::ply::parse(bytes, "fuzz.ply"));
});
