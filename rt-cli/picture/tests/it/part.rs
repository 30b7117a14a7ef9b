//! Finished tiles, in files that may have been cut anywhere.

use glam::Vec3;
use proptest::prelude::*;
use rt_picture::part::{Part, header, read, record};

fn lines() -> Vec<String> {
    ["scene größe.obj", "", "two\nlines"].map(str::to_owned).to_vec()
}

fn tile(n: u32) -> Vec<Vec3> {
    (0..n).map(|i| Vec3::new(i as f32, f32::INFINITY, -0.0)).collect()
}

#[test]
fn what_is_added_is_found() {
    let file = [header(&lines()), record(7, &tile(3)), record(2, &tile(0)), record(9, &tile(40))];
    let part = read(&file.concat()).unwrap();
    assert_eq!(part.lines, ["scene größe.obj", " ", "two lines"]);
    assert_eq!(part.tiles, [(2, tile(0)), (7, tile(3)), (9, tile(40))].into());
    assert_eq!(part.len, file.concat().len());
    assert_eq!(read(&header(&[])).unwrap(), Part { lines: vec![], tiles: [].into(), len: 11 });
}

#[test]
fn a_cut_ends_it_before_the_record_that_was_cut() {
    let (header, one, two) = (header(&lines()), record(0, &tile(5)), record(1, &tile(6)));
    let file = [&header[..], &one, &two].concat();
    for end in 0..file.len() {
        let part = read(&file[..end]);
        match part {
            None => assert!(end < header.len(), "{end}"),
            Some(part) => {
                let whole = usize::from(end >= header.len() + one.len());
                assert_eq!(part.tiles.len(), whole, "{end}");
                assert_eq!(part.len, header.len() + whole * one.len());
            }
        }
    }
}

#[test]
fn what_is_none_is_not_read() {
    let claims = [&header(&[])[..], &[0, 0, 0, 0, 255, 255, 255, 255]].concat();
    assert_eq!(read(&claims).unwrap().tiles.len(), 0);
    for bad in [&b""[..], b"rt part 2\n\n", b"\n\n", b"rt part 1\n\xFF\n\n", b"rt part 1"] {
        assert_eq!(read(bad), None);
    }
}

proptest! {
    #[test]
    fn a_changed_byte_never_passes(at in 0..88_usize, flip in 1..=255_u8) {
        let header = header(&lines());
        let mut record = record(3, &tile(6));
        record[at] ^= flip;
        let part = read(&[&header[..], &record].concat()).unwrap();
        prop_assert_eq!(part.tiles.len(), 0);
    }
}
