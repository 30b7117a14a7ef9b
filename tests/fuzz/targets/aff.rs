//! Any bytes as an AFF file, of which the second half is one that it includes.
#![no_main]

use std::io::{Error, ErrorKind};

libfuzzer_sys::fuzz_target!(|bytes: &[u8]| {
    let (main, other) = bytes.split_at(bytes.len() / 2);
    let mut load = |name: &str| match name {
        "a" => Ok(other.to_vec()),
        _ => Err(Error::from(ErrorKind::NotFound)),
    };
    rt_fuzz::check(rt_scene::aff::parse(main, "fuzz.aff", &mut load));
});
