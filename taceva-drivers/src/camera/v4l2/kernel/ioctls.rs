//! Structures and constants of `linux/videodev2.h`, and the ioctl calls that exchange the structures with the kernel.
#![expect(
    unsafe_code,
    reason = "an ioctl is a pointer for the kernel to read and write"
)]

use std::os::fd::BorrowedFd;

use rustix::io::Errno;
use rustix::ioctl::{Updater, ioctl, opcode};

/// Buffer type of all calls: single-plane video capture.
pub(crate) const CAPTURE: u32 = 1;
/// Memory type of all buffers: kernel memory that the program maps.
pub(crate) const SHARED: u32 = 1;

/// Capability bit for video capture. The next bits mean streaming, and that [`Capability::own`] is valid.
pub(crate) const CAN_CAPTURE: u32 = 0x1;
pub(crate) const CAN_STREAM: u32 = 0x0400_0000;
pub(crate) const TELLS_OF_ITSELF: u32 = 0x8000_0000;

/// Identity and capabilities of a video device, from the kernel.
#[repr(C)]
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Capability {
    pub(crate) driver: [u8; 16],
    pub(crate) card: [u8; 32],
    pub(crate) bus: [u8; 32],
    pub(crate) version: u32,
    /// Capability bits of the physical device, over all its device files.
    pub(crate) all: u32,
    /// Capability bits of the opened device file.
    pub(crate) own: u32,
    pub(crate) reserved: [u32; 3],
}

/// One pixel format that the camera supports.
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

/// One image size that the camera supports for a pixel format.
#[repr(C)]
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Size {
    pub(crate) index: u32,
    pub(crate) pixels: u32,
    /// 1 if `numbers` begins with one width and height; otherwise `numbers` holds ranges and steps.
    pub(crate) kind: u32,
    pub(crate) numbers: [u32; 6],
    pub(crate) reserved: [u32; 2],
}

/// Image format that the program requests and the camera sets.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub(crate) struct Format {
    pub(crate) kind: u32,
    pub(crate) padding: u32,
    pub(crate) width: u32,
    pub(crate) height: u32,
    pub(crate) pixels: u32,
    /// Interlacing: 1 for progressive images.
    pub(crate) field: u32,
    /// Distance between the starts of two rows, bytes.
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

/// Frame rate of the camera, stored as the duration of one frame.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub(crate) struct Rate {
    pub(crate) kind: u32,
    /// Capability bits: 0x1000 if the frame duration can be set.
    pub(crate) capability: u32,
    pub(crate) mode: u32,
    /// Numerator and denominator of the frame duration, s.
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

/// Request for `count` image buffers that the kernel shares with the program.
#[repr(C)]
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Request {
    pub(crate) count: u32,
    pub(crate) kind: u32,
    pub(crate) memory: u32,
    pub(crate) rest: [u32; 2],
}

/// Description of one image buffer and of the image in it.
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
    /// Time stamp of the image: whole seconds, and microseconds within the second.
    pub(crate) time: [i64; 2],
    pub(crate) code: [u32; 4],
    /// Sequence number, increased by one per captured image.
    pub(crate) number: u32,
    pub(crate) memory: u32,
    /// Offset at which the program maps the buffer, if `memory` is [`SHARED`]. For other memory types this field holds a pointer.
    pub(crate) offset: u64,
    pub(crate) length: u32,
    pub(crate) reserved: u32,
    pub(crate) request: u32,
    pub(crate) end: u32,
}

/// Bit of [`Buffer::flags`] that marks the image as damaged.
pub(crate) const DAMAGED: u32 = 0x40;
/// Mask for the bits of [`Buffer::flags`] that name the clock of the time stamp. [`MONOTONIC`] is the value for the monotonic clock.
pub(crate) const CLOCKS: u32 = 0xe000;
pub(crate) const MONOTONIC: u32 = 0x2000;

/// Properties of a camera control, such as its range and default value.
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

/// Bit that is set in a control number to query the control with the next higher number.
pub(crate) const NEXT_CONTROL: u32 = 0x8000_0000;

/// Number and value of a camera control.
#[repr(C)]
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct ControlValue {
    pub(crate) id: u32,
    pub(crate) value: i32,
}

/// Defines a function for an ioctl call whose argument is one structure. The function repeats a call that a signal interrupts.
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
