//! Numbers of a taxel that probably mean "nothing measured", such as -1 among distances.

/// Frequent number of a taxel, far from all its other numbers.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct TaxelCode {
    pub(crate) value: f64,
    pub(crate) count: usize,
    /// Nearest other number.
    pub(crate) nearest: f64,
}

/// Full-scale numbers of A/D converters and of displays.
const GREATEST: [f64; 7] = [
    255.0, 1_023.0, 4_095.0, 32_767.0, 65_535.0, 99_999.0, 9_999.0,
];
/// Minimum number of rows with the same code. The code must also be in at least one of `SHARE` rows.
const LEAST: usize = 3;
const SHARE: usize = 50;
/// Minimum distance of a negative code from the nearest other number. Noise has smaller distances.
const FAR: f64 = 2.0;
/// Minimum distance of a full-scale code from the nearest other number, as a fraction of the range of all other numbers.
const FAR_SHARE: f64 = 0.25;

/// Codes among the numbers of one taxel: at most its least and its greatest number.
pub(crate) fn codes(mut numbers: Vec<f64>) -> Vec<TaxelCode> {
    numbers.sort_unstable_by(f64::total_cmp);
    let of_end = |value: f64, is_least: bool| -> Option<TaxelCode> {
        let is_other = |number: &f64| number.total_cmp(&value).is_ne();
        let others: Vec<f64> = numbers.iter().copied().filter(is_other).collect();
        let (least, greatest) = (*others.first()?, *others.last()?);
        let range = greatest - least;
        let nearest = if is_least { least } else { greatest };
        let gap = (value - nearest).abs();
        let is_code = match is_least {
            // Noise of whole numbers around 0 is within their range.
            true => value < 0.0 && nearest >= 0.0 && (gap >= FAR || (range > 0.0 && gap > range)),
            false => GREATEST.contains(&value) && gap > FAR_SHARE * range,
        };
        let count = numbers.len() - others.len();
        let is_frequent = count >= LEAST && count * SHARE >= numbers.len();
        (is_code && is_frequent).then_some(TaxelCode {
            value,
            count,
            nearest,
        })
    };
    let least = numbers.first().and_then(|least| of_end(*least, true));
    let greatest = numbers.last().and_then(|last| of_end(*last, false));
    least.into_iter().chain(greatest).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Codes of a hundred numbers, ten of which are `code`.
    fn found(code: f64, other: impl Fn(u32) -> f64) -> Vec<f64> {
        let number = |row: u32| match row % 10 {
            0 => code,
            _ => other(row),
        };
        let codes = codes((0..100).map(number).collect());
        codes.into_iter().map(|code| code.value).collect()
    }

    #[test]
    fn noise_of_whole_numbers_and_saturation_are_no_codes() {
        let metres = |row: u32| 0.01 * f64::from(row % 10);
        assert_eq!(found(-1.0, metres), [-1.0]);
        assert_eq!(found(65_535.0, f64::from), [65_535.0]);
        for (code, width) in [(-1.0, 1), (-1.0, 2), (255.0, 255)] {
            let other = |row: u32| f64::from(row * 7 % width);
            assert_eq!(found(code, other), [0.0; 0], "{code} {width}");
        }
    }
}
