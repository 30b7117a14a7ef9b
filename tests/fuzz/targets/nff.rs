//! Any bytes as an NFF file.
#![no_main]

libfuzzer_sys::fuzz_target!(|bytes: &[u8]| {
    rt_fuzz::check(rt_scene::nff::parse(bytes, "fuzz.nff"));
});
