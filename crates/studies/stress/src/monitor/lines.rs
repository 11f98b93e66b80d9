//! Picture lines that change between successive pictures.

use taceva_core::Frame;

/// Mean absolute change of the line that changes most from `before` to `frame`, minus the mean over all lines. The unit is full scale. A lasting
/// change appears only in the first pair of pictures.
pub(super) fn line_change(before: &Frame, frame: &Frame) -> f64 {
    let info = frame.info();
    let length = info.width as usize * info.format.samples();
    let height = info.height as usize;
    if length == 0 || height == 0 {
        return 0.0;
    }
    let mut lines = vec![0_u64; height];
    let numbers = before.samples().zip(frame.samples());
    for (place, (before, now)) in numbers.enumerate() {
        lines[place / length] += u64::from(before.abs_diff(now));
    }
    let farthest = lines.iter().copied().max().unwrap_or_default();
    let mean = lines.iter().sum::<u64>() as f64 / height as f64;
    (farthest as f64 - mean) / (length as f64 * f64::from(info.format.full_scale()))
}

#[cfg(test)]
mod tests {
    use taceva_core::{FrameInfo, PixelFormat};

    use super::*;

    #[test]
    fn the_change_of_a_line_is_that_of_no_whole_picture() {
        let info = FrameInfo {
            width: 8,
            height: 4,
            format: PixelFormat::Gray8,
        };
        let picture = |of: fn(usize) -> u8| {
            let numbers = (0..32).map(|place| of(place / 8));
            Frame::new(info, numbers.collect()).expect("whole")
        };
        let rest = picture(|_| 100);
        let found = |other: &Frame| 255.0 * line_change(&rest, other);
        assert!(found(&picture(|_| 120)).abs() < 1e-12, "brighter");
        let lost = found(&picture(|line| if line == 2 { 20 } else { 100 }));
        assert!(
            (lost - 60.0).abs() < 1e-9,
            "80 of one line less 20 of the mean: {lost}"
        );
    }
}
