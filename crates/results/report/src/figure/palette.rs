//! Colours that are distinguishable with any colour vision.

/// Number of series with their own colour.
pub const SERIES: usize = 7;

/// Series colours on white, by Okabe and Ito, with a darker yellow.
pub const LIGHT: [&str; SERIES] = [
    "#0072b2", "#d55e00", "#009e73", "#b5568d", "#c98a00", "#3d9bd6", "#857c00",
];
/// The same hues for a black background, lightened to the same contrast.
pub const DARK: [&str; SERIES] = [
    "#5cb3ea", "#ff8d4a", "#3fcba1", "#e59ac8", "#f2b94b", "#9ad4f7", "#d8cd3a",
];

/// Cividis in ten steps: uniform in lightness, and equal for red-green colour blindness (Nuñez, Anderton and Renslow, 2018).
const CIVIDIS: [[u8; 3]; 10] = [
    [0, 34, 78],
    [18, 53, 112],
    [59, 73, 108],
    [87, 93, 109],
    [112, 113, 115],
    [138, 134, 120],
    [165, 156, 116],
    [195, 179, 105],
    [225, 204, 85],
    [254, 232, 56],
];
/// Diverging scale from blue through near white to orange.
const SIGNED: [[u8; 3]; 5] = [
    [27, 94, 160],
    [146, 190, 222],
    [243, 243, 240],
    [245, 178, 120],
    [190, 85, 10],
];

/// Colour for a share from 0 to 1 on a sequential scale.
pub(crate) fn sequential(share: f64) -> [u8; 3] {
    between(&CIVIDIS, share)
}

/// Colour for a share from −1 to 1 on a diverging scale.
pub(crate) fn diverging(share: f64) -> [u8; 3] {
    between(&SIGNED, f64::midpoint(share, 1.0))
}

#[expect(
    clippy::cast_possible_truncation,
    clippy::cast_sign_loss,
    reason = "a share of a short list, and a mean of two bytes"
)]
fn between(steps: &[[u8; 3]], share: f64) -> [u8; 3] {
    let last = steps.len() - 1;
    let place = share.clamp(0.0, 1.0) * last as f64;
    let below = (place as usize).min(last - 1);
    let part = place - below as f64;
    std::array::from_fn(|channel| {
        let [low, high] = [steps[below], steps[below + 1]].map(|step| f64::from(step[channel]));
        (low + part * (high - low)).round() as u8
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn scales_begin_and_end_with_their_colours() {
        assert_eq!([sequential(0.0), sequential(1.0)], [CIVIDIS[0], CIVIDIS[9]]);
        assert_eq!(
            [diverging(-1.0), diverging(0.0), diverging(7.0)],
            [SIGNED[0], SIGNED[2], SIGNED[4]]
        );
    }
}
