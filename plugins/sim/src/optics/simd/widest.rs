#![expect(
    unsafe_code,
    reason = "a function compiled for AVX2 is called only after AVX2 was detected"
)]
//! Compiles rendering code twice: for every processor, and for processors with AVX2.
//!
//! Vectors of eight and of four give the same result in each lane. No multiplication is fused with an addition, so that both give the same bytes.

use crate::optics::camera::Camera;
use crate::optics::luma::Luma;
use crate::optics::view::View;

/// [`Camera::expose`] with the widest vectors of this processor.
pub(in crate::optics) fn expose(camera: &mut Camera, view: &View, bytes: &mut [u8]) -> Luma {
    #[cfg(target_arch = "x86_64")]
    if is_x86_feature_detected!("avx2") {
        // SAFETY: AVX2 was detected just before.
        return unsafe { expose_with_avx2(camera, view, bytes) };
    }
    camera.expose(view, bytes)
}

#[cfg(target_arch = "x86_64")]
#[target_feature(enable = "avx2")]
fn expose_with_avx2(camera: &mut Camera, view: &View, bytes: &mut [u8]) -> Luma {
    camera.expose(view, bytes)
}
