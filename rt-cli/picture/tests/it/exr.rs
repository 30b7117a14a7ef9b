//! OpenEXR, beside a crate that does all of it.

use std::io::Cursor;

use exr::prelude::{
    Compression, Encoding, Image, Layer, LayerAttributes, ReadChannels, ReadLayers,
    SpecificChannels, WritableImage, f16,
};
use glam::Vec3;
use rt_picture::{Format, Scale, write};

use crate::support::{bits, linear};

/// Of an odd size, so that the last rows are fewer than go together.
const SIZE: (u32, u32) = (37, 21);

#[test]
fn others_read_what_is_written() {
    let picture = linear(SIZE.0, SIZE.1);
    let file = write(&picture, Format::Exr, &[]).unwrap();
    let black = |size: exr::math::Vec2<usize>, _: &_| (size.0, vec![Vec3::ZERO; size.0 * size.1]);
    let set = |(width, pixels): &mut (usize, Vec<Vec3>),
               at: exr::math::Vec2<usize>,
               (r, g, b): (f32, f32, f32)| {
        pixels[at.1 * *width + at.0] = Vec3::new(r, g, b);
    };
    let image = exr::image::read::read()
        .no_deep_data()
        .largest_resolution_level()
        .rgb_channels(black, set)
        .first_valid_layer()
        .all_attributes()
        .pedantic()
        .from_buffered(Cursor::new(file))
        .unwrap();
    let (width, pixels) = image.layer_data.channel_data.pixels;
    assert_eq!(width, SIZE.0 as usize);
    let again = rt_picture::Picture { pixels, ..picture.clone() };
    assert_eq!(bits(&again), bits(&picture));
}

#[test]
fn what_others_write_is_read() {
    let picture = linear(SIZE.0, SIZE.1);
    let at = |at: exr::math::Vec2<usize>| picture.pixels[at.1 * SIZE.0 as usize + at.0];
    for compression in [Compression::Uncompressed, Compression::ZIP1, Compression::ZIP16] {
        let encoding = Encoding { compression, ..Encoding::UNCOMPRESSED };
        let write = |halves: bool| {
            let size = (SIZE.0 as usize, SIZE.1 as usize);
            let attributes = LayerAttributes::named("it");
            let mut file = Cursor::new(Vec::new());
            if halves {
                // Another channel beside, which is no colour.
                let channels = SpecificChannels::rgba(|p| {
                    let [r, g, b] = at(p).to_array().map(f16::from_f32);
                    (r, g, b, f16::ONE)
                });
                let layer = Layer::new(size, attributes, encoding, channels);
                Image::from_layer(layer).write().to_buffered(&mut file).unwrap();
            } else {
                let channels = SpecificChannels::rgb(|p| at(p).into());
                let layer = Layer::new(size, attributes, encoding, channels);
                Image::from_layer(layer).write().to_buffered(&mut file).unwrap();
            }
            rt_picture::read(file.get_ref()).unwrap()
        };
        let again = write(false);
        assert_eq!((again.width, again.height, again.scale), (SIZE.0, SIZE.1, Scale::Linear));
        assert_eq!(bits(&again), bits(&picture), "{compression:?}");
        let rounded = |x: f32| f16::from_f32(x).to_f32();
        let halves: Vec<_> =
            picture.pixels.iter().map(|p| Vec3::from_array(p.to_array().map(rounded))).collect();
        assert_eq!(write(true).pixels, halves, "{compression:?}");
    }
}

#[test]
fn a_brightness_is_grey() {
    let channels = SpecificChannels::build()
        .with_channel::<f32>("Y")
        .with_pixel_fn(|p: exr::math::Vec2<usize>| (p.0 as f32,));
    let attributes = LayerAttributes::named("it");
    let layer = Layer::new((3, 2), attributes, Encoding::UNCOMPRESSED, channels);
    let mut file = Cursor::new(Vec::new());
    Image::from_layer(layer).write().to_buffered(&mut file).unwrap();
    let picture = rt_picture::read(file.get_ref()).unwrap();
    assert_eq!(picture.pixels[2], Vec3::splat(2.0));
}
