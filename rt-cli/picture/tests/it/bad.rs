//! Broken and hostile files.

use proptest::prelude::*;
use rt_picture::png::Depth;
use rt_picture::{Error, Format, read, write};

use crate::support::linear;

const FORMATS: [Format; 4] =
    [Format::Png(Depth::Eight), Format::Png(Depth::Sixteen), Format::Pfm, Format::Exr];

fn good(format: Format) -> Vec<u8> {
    write(&linear(5, 4), format, &[("Scene", "a.obj".to_owned())]).unwrap()
}

/// A good file with one run of bytes replaced by another of its length.
fn patched(format: Format, old: &[u8], new: &[u8]) -> Vec<u8> {
    let mut file = good(format);
    let at = file.windows(old.len()).position(|window| window == old).expect("it is there");
    file.splice(at..at + old.len(), new.iter().copied());
    file
}

#[track_caller]
fn error(file: &[u8]) -> String {
    read(file).expect_err("it is broken").to_string()
}

#[test]
fn what_is_wrong_is_said() {
    let exr = |old: &[u8], new: &[u8]| error(&patched(Format::Exr, old, new));
    let window = |ints: [i32; 4]| ints.map(i32::to_le_bytes).concat();
    let own = window([0, 0, 4, 3]);
    let compression =
        |kind: u8| exr(b"ssion\0\x01\0\0\0\0", &[b"ssion\0\x01\0\0\0", &[kind][..]].concat());
    let version = |bytes: &[u8]| {
        exr(&[0x76, 0x2F, 0x31, 0x01, 2, 0], &[&[0x76, 0x2F, 0x31, 0x01], bytes].concat())
    };
    for (message, wanted) in [
        (error(b""), "this is no PNG, PFM or OpenEXR file"),
        (error(b"GIF89a"), "this is no PNG, PFM or OpenEXR file"),
        (error(b"PF"), "PFM at byte 2: expected 1 more bytes, found 0"),
        (error(b"PF\n"), "PFM at byte 3: expected 1 more bytes, found 0"),
        (
            error(b"PF\n2 2\n-1\n123"),
            "PFM at byte 0: 2x2 pixels do not fit into a file of 13 bytes",
        ),
        (error(b"PF\n1 1\n-1\n12345678901"), "PFM at byte 10: expected 12 more bytes, found 11"),
        (
            error(b"PF\n1 1\n-1\n1234567890123"),
            "PFM at byte 22: expected the end of the file, found 1 more bytes",
        ),
        (error(b"PF\n-1 1\n-1\n"), "PFM at byte 6: expected a width, found '-1'"),
        (error(b"PF\n1 x\x1B\n-1\n"), "PFM at byte 8: expected a height, found 'x.'"),
        (error(b"PF\n1 1\n0\n"), "PFM at byte 9: expected a scale factor other than 0, found 0"),
        (
            error(b"PF\n1 1\nnan\n"),
            "PFM at byte 11: expected a scale factor other than 0, found NaN",
        ),
        (
            error(b"PF\n0 9\n-1\n"),
            "PFM at byte 0: a picture of 0x9 pixels is not read: 1 to 134217728 are",
        ),
        (
            error(b"PF\n4294967295 4294967295\n-1\n"),
            "PFM at byte 0: a picture of 4294967295x4294967295 pixels is not read: 1 to 134217728 are",
        ),
        (
            error(&[b"PF\n".as_slice(), &[b'1'; 99]].concat()),
            "PFM at byte 35: expected a word of up to 32 bytes in the header",
        ),
        (
            exr(&own, &window([0, 0, i32::MAX, i32::MAX])),
            "OpenEXR at byte 0: a picture of 2147483648x2147483648 pixels is not read: 1 to 134217728 are",
        ),
        (
            exr(&own, &window([i32::MIN, 0, i32::MAX, 0])),
            "OpenEXR at byte 0: a picture of 4294967296x1 pixels is not read: 1 to 134217728 are",
        ),
        (
            exr(&own, &window([0, 0, -1, 3])),
            "OpenEXR at byte 0: a picture of 0x4 pixels is not read: 1 to 134217728 are",
        ),
        (
            exr(&own, &window([0, 0, 9999, 9999])),
            "OpenEXR at byte 0: 10000x10000 pixels do not fit into a file of 617 bytes",
        ),
        (exr(&own, &window([0, 1, 4, 3])), "OpenEXR at byte 349: expected a row of the picture"),
        (compression(1), "OpenEXR: compression RLE is not read"),
        (compression(9), "OpenEXR: compression DWAB is not read"),
        (compression(77), "OpenEXR: compression 77 is not read"),
        (compression(3), "OpenEXR at byte 413: rows do not inflate"),
        (version(&[3, 0]), "OpenEXR: version 3 is not read"),
        (version(&[2, 2]), "OpenEXR: a picture in tiles is not read"),
        (version(&[2, 8]), "OpenEXR: a picture with depth is not read"),
        (version(&[2, 16]), "OpenEXR: a picture of several parts is not read"),
        (version(&[2, 128]), "OpenEXR: it has flags that are not known"),
        (
            exr(b"R\0\x02\0\0\0", b"r\0\x02\0\0\0"),
            "OpenEXR: a picture without either R, G and B or Y is not read",
        ),
        (
            exr(b"G\0\x02\0\0\0", b"R\0\x02\0\0\0"),
            "OpenEXR: a picture without either R, G and B or Y is not read",
        ),
        (
            exr(b"R\0\x02\0\0\0", b"R\0\x03\0\0\0"),
            "OpenEXR at byte 42: expected a type of 0, 1 or 2, found 3",
        ),
        (
            exr(b"chlist\0\x37\0\0\0", b"chlist\0\xFF\xFF\xFF\xFF"),
            "OpenEXR at byte 28: expected a length, found -1",
        ),
        (
            exr(b"chlist\0\x37\0\0\0", b"chlist\0\xFF\xFF\xFF\x7F"),
            "OpenEXR at byte 28: expected 2147483647 more bytes, found 589",
        ),
        (exr(b"dataWindow", b"dateWindow"), "OpenEXR at byte 0: it has no dataWindow"),
        (exr(b"compression\0c", b"compressiom\0c"), "OpenEXR at byte 0: it has no compression"),
    ] {
        assert_eq!(message, wanted);
    }
}

#[test]
fn a_png_that_claims_too_much_is_refused() {
    for (size, wanted) in [
        ([0, 0, 0x27, 0x10], "10000x10000 pixels do not fit into a file of 159 bytes"),
        ([0x7F, 0xFF, 0xFF, 0xFF], "limits are exceeded"),
    ] {
        let mut file = good(Format::Png(Depth::Eight));
        file[16..20].copy_from_slice(&size);
        file[20..24].copy_from_slice(&size);
        // Its sum, so that the size is believed.
        let sum = crc(&file[12..29]).to_be_bytes();
        file[29..33].copy_from_slice(&sum);
        let message = error(&file);
        assert!(message.contains(wanted), "{message}");
    }
}

/// Of a colour and a third: sums and all else are as they should be.
#[test]
fn a_png_whose_palette_ends_within_a_colour_is_refused() {
    let parts: [&[u8]; 3] = [
        b"\x89PNG\r\n\x1a\n\x00\x00\x00\rIHDR\x00\x00\x00\x01\x00\x00\x00\x01\x08\x03\x00\x00\x00(\xcb4\xbb",
        b"\x00\x00\x00\x04PLTE\x01\x02\x03\x04#\xdb\x8a\xab",
        b"\x00\x00\x00\nIDATx\x9cc`\x00\x00\x00\x02\x00\x01H\xaf\xa4q",
    ];
    let message = error(&parts.concat());
    assert!(message.ends_with("its palette ends within a colour"), "{message}");
}

/// The checksum of PNG, as its standard has it.
fn crc(bytes: &[u8]) -> u32 {
    !bytes.iter().fold(!0, |crc, &byte| {
        (0..8).fold(crc ^ u32::from(byte), |crc, _| {
            (crc >> 1) ^ (0xEDB8_8320 & (crc & 1).wrapping_neg())
        })
    })
}

#[test]
fn cut_files_are_refused() {
    for format in FORMATS {
        let good = good(format);
        // What ends a PNG is not needed for its pixels.
        let needed = if matches!(format, Format::Png(_)) { good.len() - 16 } else { good.len() };
        for end in 0..needed {
            let cut = read(&good[..end]);
            assert!(cut.is_err(), "{format:?} cut after {end} bytes");
        }
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(3000))]

    #[test]
    fn damaged_files_are_read_or_refused(
        which in 0..4_usize,
        changes in prop::collection::vec((any::<prop::sample::Index>(), any::<u8>()), 1..6),
    ) {
        let mut file = good(FORMATS[which]);
        for (place, byte) in changes {
            let at = place.index(file.len());
            file[at] = byte;
        }
        match read(&file) {
            Ok(picture) => {
                let size = u64::from(picture.width) * u64::from(picture.height);
                prop_assert_eq!(picture.pixels.len() as u64, size);
            }
            Err(Error::Encode(_)) => prop_assert!(false, "nothing was written"),
            Err(error) => prop_assert!(error.to_string().len() < 200),
        }
    }
}
