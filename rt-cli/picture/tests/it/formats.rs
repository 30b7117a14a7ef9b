//! Whatever is written is read again, and nothing else has to be known.

use std::io::Cursor;
use std::path::Path;

use glam::Vec3;
use rt_picture::png::Depth;
use rt_picture::{Error, Format, Picture, Scale, format_of, read, srgb, write};

use crate::support::{bits, linear};

#[test]
fn floats_keep_their_bits() {
    for (width, height) in [(1, 1), (7, 5), (64, 3), (1, 40)] {
        let picture = linear(width, height);
        for format in [Format::Pfm, Format::Exr] {
            let again = read(&write(&picture, format, &[]).unwrap()).unwrap();
            assert_eq!((again.width, again.height), (width, height));
            assert_eq!(again.scale, Scale::Linear);
            assert_eq!(bits(&again), bits(&picture), "{format:?} {width}x{height}");
        }
    }
}

/// The first pixel of the file is the left one of the lowest row.
#[test]
fn a_pfm_is_what_its_definition_says() {
    let pixels = (0..4).map(|i| Vec3::splat(i as f32)).collect();
    let picture = Picture { width: 1, height: 4, scale: Scale::Linear, pixels };
    let file = write(&picture, Format::Pfm, &[]).unwrap();
    let mut wanted = b"PF\n1 4\n-1.0\n".to_vec();
    for grey in [3.0_f32, 2.0, 1.0, 0.0] {
        wanted.extend([grey.to_le_bytes(); 3].concat());
    }
    assert_eq!(file, wanted);
}

#[test]
fn greys_of_the_other_byte_order_are_read() {
    let mut file = b"Pf\n2 2\n1.0\n".to_vec();
    for grey in [0.25_f32, 0.5, -1.0, 9.0] {
        file.extend(grey.to_be_bytes());
    }
    let picture = read(&file).unwrap();
    let greys: Vec<_> = picture.pixels.iter().map(|pixel| pixel.y).collect();
    assert_eq!(greys, [-1.0, 9.0, 0.25, 0.5]);
    assert_eq!(picture.pixels[1], Vec3::splat(9.0));
}

#[test]
fn a_png_has_its_codes_and_text() {
    let picture = linear(9, 4);
    let channels: Vec<f32> = picture.pixels.iter().flat_map(|p| p.to_array()).collect();
    for depth in [Depth::Eight, Depth::Sixteen] {
        let text = [("Scene", "größe.obj".to_owned()), ("Size", "9x4".to_owned())];
        let file = write(&picture, Format::Png(depth), &text).unwrap();
        let mut reader = png::Decoder::new(Cursor::new(&file)).read_info().unwrap();
        let mut codes = vec![0; reader.output_buffer_size().unwrap()];
        let frame = reader.next_frame(&mut codes).unwrap();
        assert_eq!(frame.color_type, png::ColorType::Rgb);
        let wanted: Vec<u8> = match depth {
            Depth::Eight => channels.iter().map(|&x| srgb::encode8(x)).collect(),
            Depth::Sixteen => {
                channels.iter().flat_map(|&x| srgb::encode16(x).to_be_bytes()).collect()
            }
        };
        assert_eq!(codes, wanted);
        reader.finish().unwrap();
        assert!(reader.info().srgb.is_some());
        let found: Vec<_> = reader
            .info()
            .utf8_text
            .iter()
            .map(|chunk| (chunk.keyword.clone(), chunk.get_text().unwrap()))
            .collect();
        assert_eq!(found, text.clone().map(|(keyword, text)| (keyword.to_owned(), text)));

        // Read again, and written again as it was read, it is the same.
        let again = read(&file).unwrap();
        assert_eq!(again.scale, Scale::Srgb);
        assert_eq!(write(&again, Format::Png(depth), &text).unwrap(), file);
    }
}

#[test]
fn pngs_of_every_kind_are_read() {
    use png::{BitDepth, ColorType};
    let encode = |color, depth, codes: &[u8]| {
        let mut file = Vec::new();
        let mut encoder = png::Encoder::new(&mut file, 2, 1);
        encoder.set_color(color);
        encoder.set_depth(depth);
        if color == ColorType::Indexed {
            encoder.set_palette(vec![255, 0, 0, 0, 255, 0]);
            encoder.set_trns(vec![7]);
        }
        encoder.write_header().unwrap().write_image_data(codes).unwrap();
        read(&file).unwrap().pixels
    };
    let (red, green, black, white) = (Vec3::X, Vec3::Y, Vec3::ZERO, Vec3::ONE);
    assert_eq!(encode(ColorType::Grayscale, BitDepth::One, &[0x40]), [black, white]);
    assert_eq!(encode(ColorType::Grayscale, BitDepth::Sixteen, &[0, 0, 255, 255]), [black, white]);
    assert_eq!(encode(ColorType::GrayscaleAlpha, BitDepth::Eight, &[0, 9, 255, 9]), [black, white]);
    assert_eq!(encode(ColorType::Indexed, BitDepth::Eight, &[1, 0]), [green, red]);
    let rgba = [255, 0, 0, 1, 0, 255, 0, 2];
    assert_eq!(encode(ColorType::Rgba, BitDepth::Eight, &rgba), [red, green]);
}

#[test]
fn extensions_tell_formats() {
    let format = |name: &str| format_of(Path::new(name));
    assert_eq!(format("a.PNG"), Some(Format::Png(Depth::Eight)));
    assert_eq!((format("a.pfm"), format("b.c.exr")), (Some(Format::Pfm), Some(Format::Exr)));
    assert_eq!((format("a.jpg"), format("png")), (None, None));
}

#[test]
fn a_picture_that_is_none_is_not_written() {
    for (width, height) in [(0, 0), (2, 3), (5, 1)] {
        let picture = Picture { width, height, ..linear(2, 2) };
        for format in [Format::Pfm, Format::Exr, Format::Png(Depth::Eight)] {
            assert!(matches!(write(&picture, format, &[]), Err(Error::Encode(_))));
        }
    }
}
