//! Structures and numbers of `linux/videodev2.h`, and the ioctl calls that exchange them.
#![expect(
    unsafe_code,
    reason = "an ioctl is a pointer for the kernel to read and write"
)]

use std::os::fd::BorrowedFd;

use rustix::io::Errno;
use rustix::ioctl::{Updater, ioctl, opcode};

/// Buffer type used here: single-plane video capture.
pub(crate) const CAPTURE: u32 = 1;
/// Memory type used here: kernel buffers that the program maps.
pub(crate) const SHARED: u32 = 1;

/// Capability bits of a device.
pub(crate) const CAN_CAPTURE: u32 = 0x1;
pub(crate) const CAN_STREAM: u32 = 0x0400_0000;
pub(crate) const TELLS_OF_ITSELF: u32 = 0x8000_0000;

/// Identity and capabilities of a device.
#[repr(C)]
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Capability {
    pub(crate) driver: [u8; 16],
    pub(crate) card: [u8; 32],
    pub(crate) bus: [u8; 32],
    pub(crate) version: u32,
    /// Capabilities of the whole device.
    pub(crate) all: u32,
    /// Capabilities of this device file.
    pub(crate) own: u32,
    pub(crate) reserved: [u32; 3],
}

/// One supported format.
#[repr(C)]
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct FormatName {
    pub(crate) index: u32,
    pub(crate) kind: u32,
    pub(crate) flags: u32,
    pub(crate) description: [u8; 32],
    pub(crate) pixels: u32,
    pub(crate) code: u32,
    pub(crate) reserved: [u32; 3],
}

/// One supported size of a format.
#[repr(C)]
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Size {
    pub(crate) index: u32,
    pub(crate) pixels: u32,
    /// 1 if the numbers are width and height; otherwise they are ranges and steps.
    pub(crate) kind: u32,
    pub(crate) numbers: [u32; 6],
    pub(crate) reserved: [u32; 2],
}

/// Image format.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub(crate) struct Format {
    pub(crate) kind: u32,
    pub(crate) padding: u32,
    pub(crate) width: u32,
    pub(crate) height: u32,
    pub(crate) pixels: u32,
    /// 1 for progressive images.
    pub(crate) field: u32,
    /// Row stride, bytes.
    pub(crate) stride: u32,
    /// Maximum size of an image, bytes.
    pub(crate) bytes: u32,
    pub(crate) colours: u32,
    pub(crate) private: u32,
    pub(crate) flags: u32,
    pub(crate) coding: u32,
    pub(crate) range: u32,
    pub(crate) transfer: u32,
    pub(crate) rest: [u32; 38],
}

impl Default for Format {
    fn default() -> Format {
        Format {
            kind: CAPTURE,
            padding: 0,
            width: 0,
            height: 0,
            pixels: 0,
            field: 1,
            stride: 0,
            bytes: 0,
            colours: 0,
            private: 0,
            flags: 0,
            coding: 0,
            range: 0,
            transfer: 0,
            rest: [0; 38],
        }
    }
}

/// Frame rate, as the duration of one frame.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub(crate) struct Rate {
    pub(crate) kind: u32,
    /// 0x1000 if the duration can be set.
    pub(crate) capability: u32,
    pub(crate) mode: u32,
    /// Duration of a frame, s: numerator and denominator.
    pub(crate) time: [u32; 2],
    pub(crate) rest: [u32; 46],
}

impl Default for Rate {
    fn default() -> Rate {
        Rate {
            kind: CAPTURE,
            capability: 0,
            mode: 0,
            time: [0; 2],
            rest: [0; 46],
        }
    }
}

/// Number of shared buffers.
#[repr(C)]
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Request {
    pub(crate) count: u32,
    pub(crate) kind: u32,
    pub(crate) memory: u32,
    pub(crate) rest: [u32; 2],
}

/// A buffer with its image.
#[repr(C)]
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Buffer {
    pub(crate) index: u32,
    pub(crate) kind: u32,
    /// Size of the image in the buffer, bytes.
    pub(crate) used: u32,
    pub(crate) flags: u32,
    pub(crate) field: u32,
    pub(crate) padding: u32,
    /// Time of capture: s and µs.
    pub(crate) time: [i64; 2],
    pub(crate) code: [u32; 4],
    /// Sequence number, increased by one per captured image.
    pub(crate) number: u32,
    pub(crate) memory: u32,
    /// Offset for mapping the buffer, if `memory` is [`SHARED`]. Otherwise the kernel stores a pointer here.
    pub(crate) offset: u64,
    pub(crate) length: u32,
    pub(crate) reserved: u32,
    pub(crate) request: u32,
    pub(crate) end: u32,
}

/// Flag of a damaged image.
pub(crate) const DAMAGED: u32 = 0x40;
/// Mask of the bits of `flags` for the time-stamp clock. [`MONOTONIC`] is the value for the monotonic clock.
pub(crate) const CLOCKS: u32 = 0xe000;
pub(crate) const MONOTONIC: u32 = 0x2000;

/// Properties of a control.
#[repr(C)]
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct ControlInfo {
    pub(crate) id: u32,
    pub(crate) kind: u32,
    pub(crate) name: [u8; 32],
    pub(crate) least: i32,
    pub(crate) greatest: i32,
    pub(crate) step: i32,
    pub(crate) usual: i32,
    pub(crate) flags: u32,
    pub(crate) reserved: [u32; 2],
}

/// Flag that requests the next control after the given number.
pub(crate) const NEXT_CONTROL: u32 = 0x8000_0000;

/// Value of a control.
#[repr(C)]
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct ControlValue {
    pub(crate) id: u32,
    pub(crate) value: i32,
}

/// Defines an ioctl call with one structure, repeated if a signal interrupts it.
macro_rules! call {
    ($(#[$doc:meta])* $name:ident, $direction:ident, $number:literal, $structure:ty) => {
        $(#[$doc])*
        pub(crate) fn $name(camera: BorrowedFd<'_>, structure: &mut $structure) -> Result<(), Errno> {
            loop {
                // SAFETY: the opcode contains the size of the structure, and the kernel accesses no byte beyond it. The structure has no padding
                // and no pointers. All its fields are integers, so every bit pattern is valid.
                let update = unsafe {
                    Updater::<{ opcode::$direction::<$structure>(b'V', $number) }, $structure>::new(structure)
                };
                // SAFETY: the opcode is one of V4L2, and this structure is its argument; any other device returns ENOTTY.
                match unsafe { ioctl(camera, update) } {
                    Err(Errno::INTR) => {}
                    done => return done,
                }
            }
        }
    };
}

call!(query_capability, read, 0, Capability);
call!(enumerate_formats, read_write, 2, FormatName);
call!(set_format, read_write, 5, Format);
call!(request_buffers, read_write, 8, Request);
call!(query_buffer, read_write, 9, Buffer);
call!(queue, read_write, 15, Buffer);
call!(take, read_write, 17, Buffer);
call!(stream_on, write, 18, u32);
call!(stream_off, write, 19, u32);
call!(get_rate, read_write, 21, Rate);
call!(set_rate, read_write, 22, Rate);
call!(get_control, read_write, 27, ControlValue);
call!(set_control, read_write, 28, ControlValue);
call!(query_control, read_write, 36, ControlInfo);
call!(enumerate_sizes, read_write, 74, Size);

// Sizes in the kernel's header. An ioctl number with another size would be another call.
const _: () = {
    assert!(size_of::<Capability>() == 104);
    assert!(size_of::<FormatName>() == 64);
    assert!(size_of::<Size>() == 44);
    assert!(size_of::<Format>() == 208);
    assert!(size_of::<Rate>() == 204);
    assert!(size_of::<Request>() == 20);
    assert!(size_of::<Buffer>() == 88);
    assert!(size_of::<ControlInfo>() == 68);
    assert!(size_of::<ControlValue>() == 8);
};

#[cfg(test)]
mod tests {
    use std::os::fd::AsFd;

    use super::*;

    #[test]
    fn opcodes_are_those_of_the_kernel() {
        assert_eq!(opcode::read::<Capability>(b'V', 0), 0x8068_5600);
        assert_eq!(opcode::read_write::<Format>(b'V', 5), 0xc0d0_5605);
        assert_eq!(opcode::read_write::<Buffer>(b'V', 15), 0xc058_560f);
        assert_eq!(opcode::write::<u32>(b'V', 18), 0x4004_5612);
        assert_eq!(opcode::read_write::<ControlInfo>(b'V', 36), 0xc044_5624);
    }

    #[test]
    fn what_is_no_camera_refuses_the_call() {
        let file = std::fs::File::open("/dev/null").expect("on every Linux");
        let refused = query_capability(file.as_fd(), &mut Capability::default());
        assert_eq!(refused, Err(Errno::NOTTY));
    }
}
