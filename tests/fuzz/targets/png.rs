//! Any bytes as a picture of one format.
#![no_main]

libfuzzer_sys::fuzz_target!(|bytes: &[u8]| rt_fuzz::check_picture(rt_picture::png::read(bytes)));
