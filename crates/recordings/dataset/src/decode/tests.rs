use super::*;
use crate::encode::encode_png;

fn frame(format: PixelFormat) -> Frame {
    let info = FrameInfo {
        width: 5,
        height: 3,
        format,
    };
    let length = info.byte_len().expect("small");
    let bytes = (0..=255).cycle().map(|byte: u8| byte.wrapping_mul(37));
    Frame::new(info, bytes.take(length).collect()).expect("of that length")
}

#[test]
fn every_pixel_format_comes_back_bit_for_bit() {
    for format in [
        PixelFormat::Gray8,
        PixelFormat::Gray16,
        PixelFormat::Rgb8,
        PixelFormat::Rgb16,
    ] {
        let order = if format.samples() == 1 {
            ChannelOrder::Gray
        } else {
            ChannelOrder::Rgb
        };
        let original = frame(format);
        let file = encode_png(&original).expect("encodes");
        let (kind, decoded) = decode(&file, order).expect("decodes");
        assert_eq!((kind, decoded), (ImageKind::Png, original));
    }
}

#[test]
fn blue_green_red_is_swapped_back() {
    for format in [PixelFormat::Rgb8, PixelFormat::Rgb16] {
        let original = frame(format);
        let file = encode_png(&original).expect("encodes");
        let (_, swapped) = decode(&file, ChannelOrder::Bgr).expect("decodes");
        let colours: Vec<u16> = original.samples().collect();
        let reversed: Vec<u16> = colours
            .chunks(3)
            .flat_map(|pixel| pixel.iter().rev().copied())
            .collect();
        assert_eq!(swapped.samples().collect::<Vec<_>>(), reversed);
    }
}

#[test]
fn an_order_that_the_pixels_contradict_is_refused() {
    let gray = encode_png(&frame(PixelFormat::Gray8)).expect("encodes");
    let message = decode(&gray, ChannelOrder::Rgb).expect_err("gray");
    assert_eq!(
        message,
        "channel order `rgb` is declared, the image is 5×3 gray8"
    );
}

#[test]
fn opaque_alpha_is_dropped_and_transparency_is_refused() {
    let file = |alpha| {
        let mut bytes = Vec::new();
        let pixels = image::RgbaImage::from_fn(4, 4, |x, _| {
            image::Rgba([9, 8, 7, if x == 3 { alpha } else { 255 }])
        });
        pixels
            .write_to(&mut Cursor::new(&mut bytes), image::ImageFormat::Png)
            .expect("encodes");
        bytes
    };
    let (_, opaque) = decode(&file(255), ChannelOrder::Rgb).expect("opaque");
    assert_eq!(opaque.bytes(), [9, 8, 7].repeat(16));
    let message = decode(&file(254), ChannelOrder::Rgb).expect_err("transparent");
    assert!(message.contains("transparent"), "{message}");
}
