//! Any bytes as an OBJ file whose libraries are not to be found.
#![no_main]

use std::io::{Error, ErrorKind};

libfuzzer_sys::fuzz_target!(|bytes: &[u8]| {
    let mut library = |_: &str| Err(Error::from(ErrorKind::NotFound));
    rt_fuzz::check(rt_scene::obj::parse(bytes, "fuzz.obj", &mut library));
});
