//! Binding of `rav1d`, which has the interface of a C library.
#![expect(unsafe_code, reason = "the library has no other interface")]

use std::mem::MaybeUninit;
use std::ptr::NonNull;
use std::slice;

use rav1d::include::dav1d::data::Dav1dData;
use rav1d::include::dav1d::dav1d::{Dav1dContext, Dav1dSettings};
use rav1d::include::dav1d::headers::{DAV1D_PIXEL_LAYOUT_I400, DAV1D_PIXEL_LAYOUT_I420};
use rav1d::include::dav1d::picture::Dav1dPicture;
use rav1d::src::lib::{
    dav1d_close, dav1d_data_create, dav1d_data_unref, dav1d_default_settings, dav1d_get_picture,
    dav1d_open, dav1d_picture_unref, dav1d_send_data,
};

use super::wire::{Answer, Yuv};

/// Error code `-EAGAIN` of the library, which requests another call.
const AGAIN: i32 = -11;

/// Reason why a packet was not decoded.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Refused {
    /// Error code of the library: a negative error number of the operating system.
    Code(i32),
    /// Unsupported kind of data, in words.
    Kind(&'static str),
}

/// Single-threaded decoder without frame delay.
pub(super) struct Decoder {
    context: Option<Dav1dContext>,
}

impl Decoder {
    /// Creates a decoder for frames of at most `pixels` pixels.
    pub(super) fn open(pixels: u32) -> Result<Decoder, i32> {
        let mut settings = MaybeUninit::<Dav1dSettings>::uninit();
        // SAFETY: the pointer is valid for the settings, and the function writes all of them.
        unsafe { dav1d_default_settings(NonNull::from(&mut settings).cast()) };
        // SAFETY: the call above initialised them.
        let mut settings = unsafe { settings.assume_init() };
        settings.n_threads = 1;
        settings.max_frame_delay = 1;
        settings.all_layers = 0;
        settings.frame_size_limit = pixels;
        let mut context = None;
        // SAFETY: both pointers are valid for the reads and writes of the function.
        let result = unsafe {
            dav1d_open(
                Some(NonNull::from(&mut context)),
                Some(NonNull::from(&mut settings)),
            )
        };
        match result.0 {
            0 => Ok(Decoder { context }),
            code => Err(code),
        }
    }

    /// Decodes `bytes`, the packet of one frame. Returns the picture only if `is_wanted`.
    pub(super) fn decode(&mut self, bytes: &[u8], is_wanted: bool) -> Result<Answer, Refused> {
        if bytes.is_empty() {
            return Ok(Answer::Decoded { has_picture: false });
        }
        let mut packet = Packet::new(bytes).ok_or(Refused::Kind("no memory for a packet"))?;
        let mut picture = None;
        while packet.0.sz > 0 {
            let before = packet.0.sz;
            // SAFETY: the context is open, and the library allocated the packet.
            let result =
                unsafe { dav1d_send_data(self.context, Some(NonNull::from(&mut packet.0))) };
            if result.0 < 0 && result.0 != AGAIN {
                return Err(Refused::Code(result.0));
            }
            let had = picture.is_some();
            while let Some(next) = self.next()? {
                // A packet has one shown frame. The last of its layers is complete.
                picture = Some(next);
            }
            if packet.0.sz == before && picture.is_some() == had {
                return Err(Refused::Kind(
                    "the decoder accepts no more data of the packet",
                ));
            }
        }
        while let Some(next) = self.next()? {
            picture = Some(next);
        }
        match picture {
            Some(picture) if is_wanted => picture.yuv().map(Answer::Picture),
            other => Ok(Answer::Decoded {
                has_picture: other.is_some(),
            }),
        }
    }

    fn next(&mut self) -> Result<Option<Shown>, Refused> {
        let mut picture = Shown(Dav1dPicture::default());
        // SAFETY: the context is open, and the pointer leads to an empty picture.
        let result =
            unsafe { dav1d_get_picture(self.context, Some(NonNull::from(&mut picture.0))) };
        match result.0 {
            0 => Ok(Some(picture)),
            AGAIN => Ok(None),
            code => Err(Refused::Code(code)),
        }
    }
}

impl Drop for Decoder {
    fn drop(&mut self) {
        // SAFETY: the context is from `dav1d_open` or null, and is closed once.
        unsafe { dav1d_close(Some(NonNull::from(&mut self.context))) };
    }
}

/// Compressed packet, whose bytes the library owns.
struct Packet(Dav1dData);

impl Packet {
    fn new(bytes: &[u8]) -> Option<Packet> {
        let mut packet = Packet(Dav1dData::default());
        // SAFETY: the pointer leads to a packet without bytes.
        let place = unsafe { dav1d_data_create(Some(NonNull::from(&mut packet.0)), bytes.len()) };
        let place = NonNull::new(place)?;
        // SAFETY: the library has just allocated that many bytes there, only for this packet.
        let place = unsafe { slice::from_raw_parts_mut(place.as_ptr(), bytes.len()) };
        place.copy_from_slice(bytes);
        Some(packet)
    }
}

impl Drop for Packet {
    fn drop(&mut self) {
        // SAFETY: the library allocated the packet, or it is empty.
        unsafe { dav1d_data_unref(Some(NonNull::from(&mut self.0))) };
    }
}

/// Picture owned by the library.
struct Shown(Dav1dPicture);

impl Shown {
    /// Copies the planes of the picture, row by row.
    fn yuv(&self) -> Result<Yuv, Refused> {
        let picture = &self.0;
        let is_gray = picture.p.layout == DAV1D_PIXEL_LAYOUT_I400;
        if picture.p.bpc != 8 || !(is_gray || picture.p.layout == DAV1D_PIXEL_LAYOUT_I420) {
            return Err(Refused::Kind("the pixels are not 8-bit 4:2:0"));
        }
        let sides = u32::try_from(picture.p.w)
            .ok()
            .zip(u32::try_from(picture.p.h).ok());
        let (width, height) = sides.ok_or(Refused::Kind("the picture has no size"))?;
        let mut planes = Vec::new();
        self.copy_plane(0, width, height, &mut planes)?;
        if !is_gray {
            self.copy_plane(1, width.div_ceil(2), height.div_ceil(2), &mut planes)?;
            self.copy_plane(2, width.div_ceil(2), height.div_ceil(2), &mut planes)?;
        }
        let header = picture
            .seq_hdr
            .ok_or(Refused::Kind("the picture has no sequence header"))?;
        // SAFETY: the picture keeps its header alive.
        let header = unsafe { header.as_ref() };
        Ok(Yuv {
            width,
            height,
            is_gray,
            matrix: u16::try_from(header.mtrx).unwrap_or(u16::MAX),
            is_full_range: header.color_range != 0,
            planes,
        })
    }

    fn copy_plane(
        &self,
        plane: usize,
        width: u32,
        height: u32,
        into: &mut Vec<u8>,
    ) -> Result<(), Refused> {
        let first = self.0.data[plane].ok_or(Refused::Kind("the picture lacks a plane"))?;
        let first = first.as_ptr().cast::<u8>().cast_const();
        let stride = self.0.stride[plane.min(1)];
        for row in 0..height as isize {
            // SAFETY: the plane has `height` rows, `stride` bytes from one to the next, all in one allocation.
            let line = unsafe { first.offset(row * stride) };
            // SAFETY: each row has `width` bytes of its plane, initialised by the decoder. Nothing writes them while the picture is held.
            let line = unsafe { slice::from_raw_parts(line, width as usize) };
            into.extend_from_slice(line);
        }
        Ok(())
    }
}

impl Drop for Shown {
    fn drop(&mut self) {
        // SAFETY: the library allocated the picture, or it is empty.
        unsafe { dav1d_picture_unref(Some(NonNull::from(&mut self.0))) };
    }
}
