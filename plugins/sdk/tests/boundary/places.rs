//! Structs that a host passes to the plugin.

use std::ptr::{null, null_mut};

use taceva_plugin::abi::{Frame, Motion, PixelFormat, Pose, Stamp};

/// Frame with `buffer`, as a host passes it to `capture`.
pub(crate) fn frame(buffer: &mut [u8]) -> Frame {
    Frame {
        size: u32::try_from(size_of::<Frame>()).expect("small"),
        format: PixelFormat(0),
        width: 0,
        height: 0,
        flags: 0,
        reserved: 0,
        sequence: 0,
        stamp: Stamp::default(),
        buffer: buffer.as_mut_ptr(),
        buffer_length: buffer.len() as u64,
        data: null(),
        length: 0,
        release: None,
        private_data: null_mut(),
    }
}

/// A slow motion to `z`, in m, positive into the gel.
pub(crate) fn motion(z: f64) -> Motion {
    Motion {
        size: u32::try_from(size_of::<Motion>()).expect("small"),
        reserved: 0,
        target: Pose {
            x: 0.0,
            y: 0.0,
            z,
            qw: 1.0,
            qx: 0.0,
            qy: 0.0,
            qz: 0.0,
        },
        speed_m_per_s: 0.002,
    }
}
