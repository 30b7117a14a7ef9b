//! Any bytes as the finished tiles of a picture.
#![no_main]

use rt_picture::part;

libfuzzer_sys::fuzz_target!(|bytes: &[u8]| {
    let Some(found) = part::read(bytes) else { return };
    assert!(found.len <= bytes.len(), "more counts than is there");
    let pixels: usize = found.tiles.values().map(Vec::len).sum();
    assert!(12 * pixels <= bytes.len(), "more pixels than fit into the file");
    // Written again, what counts is found again.
    let mut file = part::header(&found.lines);
    for (&tile, pixels) in &found.tiles {
        file.extend(part::record(tile, pixels));
    }
    let again = part::read(&file).expect("what was written");
    assert!(again.tiles.len() == found.tiles.len() && again.len == file.len(), "it is lost");
});
