//! Depth maps: videos whose pixel values are codes of distances.

use serde_json::Value;

/// Greatest 12-bit code of a depth map.
const LAST_CODE: u16 = 4095;
/// Keys of the parameters of depth codes in `meta/info.json`, without the key for logarithmic codes.
const PARAMETERS: [&str; 3] = ["video.depth_min", "video.depth_max", "video.shift"];
const LOGARITHMIC: &str = "video.use_log";

/// Distances of the codes 0 to 4095 of a depth map.
///
/// # Units
/// Distances are in millimetres from the camera. LeRobot states its parameters in metres, for any recorded unit.
///
/// ```
/// use taceva_tables::DepthCodes;
/// let codes = DepthCodes::new([0.01, 10.0], 3.5, true).ok_or("a range")?;
/// assert_eq!(codes.millimetres(0), Some(10.0));
/// assert_eq!(codes.millimetres(9).map(f64::round), Some(20.0));
/// assert_eq!(codes.millimetres(4096), None);
/// # Ok::<(), &str>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct DepthCodes {
    least_m: f64,
    greatest_m: f64,
    shift_m: f64,
    is_logarithmic: bool,
}

impl DepthCodes {
    /// Creates 4096 codes for distances in the range `ends_m`, m. Logarithmic codes are linear in ln(d + `shift_m`) for a distance d in metres.
    /// `None` if the range is empty, negative or not finite, or the logarithm is undefined.
    pub fn new(ends_m: [f64; 2], shift_m: f64, is_logarithmic: bool) -> Option<DepthCodes> {
        let [least_m, greatest_m] = ends_m;
        let are_finite = ends_m
            .iter()
            .chain([&shift_m])
            .all(|number| number.is_finite());
        let has_logarithm = !is_logarithmic || least_m + shift_m > 0.0;
        let is_range = are_finite && 0.0 <= least_m && least_m < greatest_m && has_logarithm;
        is_range.then_some(DepthCodes {
            least_m,
            greatest_m,
            shift_m,
            is_logarithmic,
        })
    }

    /// Distance of a code, mm; `None` if the code exceeds 4095.
    pub fn millimetres(&self, code: u16) -> Option<f64> {
        if code > LAST_CODE {
            return None;
        }
        let share = f64::from(code) / f64::from(LAST_CODE);
        let between = |first: f64, last: f64| first + share * (last - first);
        let metres = match self.is_logarithmic {
            true => {
                let place = |metres: f64| (metres + self.shift_m).ln();
                between(place(self.least_m), place(self.greatest_m)).exp() - self.shift_m
            }
            false => between(self.least_m, self.greatest_m),
        };
        // The stated ends are exact, without the rounding of their logarithms.
        let metres = match code {
            0 => self.least_m,
            LAST_CODE => self.greatest_m,
            _ => metres.clamp(self.least_m, self.greatest_m),
        };
        Some(metres * 1000.0)
    }

    /// Distance of the first and of the last code, mm.
    pub fn ends_mm(&self) -> [f64; 2] {
        [self.least_m * 1000.0, self.greatest_m * 1000.0]
    }

    /// True if the distances of some neighbouring codes differ by less than a millimetre.
    pub fn is_finer_than_millimetres(&self) -> bool {
        // Logarithmic codes are densest at the start.
        let first = self.millimetres(0).zip(self.millimetres(1));
        first.is_some_and(|(first, second)| second - first < 1.0)
    }
}

/// Distances of the codes of a depth feature, from its key `info`. The error names the missing key.
pub(super) fn codes(feature: &Value) -> Result<DepthCodes, String> {
    let own = |key: &str| {
        ["info", "video_info"]
            .iter()
            .find_map(|info| feature.get(*info)?.get(key))
    };
    let numbers = PARAMETERS.map(|key| own(key).and_then(Value::as_f64));
    let is_logarithmic = own(LOGARITHMIC).and_then(Value::as_bool);
    let stated = match (numbers, is_logarithmic) {
        ([Some(least), Some(greatest), Some(shift)], Some(is_logarithmic)) => {
            Some((least, greatest, shift, is_logarithmic))
        }
        _ => None,
    };
    let remedy = "write the recorder's values under `info` of the feature in meta/info.json (m; lerobot: 0.01, 10.0, 3.5, true), or write \
        the distances as a feature of numbers";
    let Some((least, greatest, shift, is_logarithmic)) = stated else {
        let known = PARAMETERS.iter().zip(numbers);
        let mut missing: Vec<&str> = known
            .filter_map(|(key, number)| number.is_none().then_some(*key))
            .collect();
        missing.extend(is_logarithmic.is_none().then_some(LOGARITHMIC));
        return Err(format!(
            "the codes of the depth map cannot be converted to millimetres without `{}`: {remedy}",
            missing.join("`, `")
        ));
    };
    DepthCodes::new([least, greatest], shift, is_logarithmic).ok_or_else(|| {
        format!(
            "the depth map is from {least} m to {greatest} m with a shift of {shift} m, which is not a valid range: {remedy}"
        )
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Compares with `lerobot` 0.6.1, which reads whole millimetres (`dequantize_depth` of NumPy).
    #[test]
    fn codes_are_the_millimetres_that_lerobot_reads() {
        let codes = DepthCodes::new([0.01, 10.0], 3.5, true).expect("a range");
        for (code, millimetres) in WHOLE {
            let own = codes.millimetres(code).map(f64::round);
            assert_eq!(own, Some(f64::from(millimetres)), "{code}");
        }
        let linear = DepthCodes::new([0.01, 10.0], 3.5, false).expect("a range");
        assert_eq!(linear.millimetres(2047).map(f64::round), Some(5004.0));
        assert!(!codes.is_finer_than_millimetres());
        let near = DepthCodes::new([0.01, 0.1], 0.0, true).expect("a range");
        assert!(near.is_finer_than_millimetres());
    }

    #[test]
    fn numbers_that_are_no_range_have_no_codes() {
        for (ends, shift) in [
            ([0.0, 1.0], 0.0),
            ([0.1, 0.1], 1.0),
            ([1.0, 0.1], 1.0),
            ([-0.1, 1.0], 1.0),
            ([0.1, f64::NAN], 1.0),
            ([0.1, 1.0], f64::INFINITY),
            ([0.1, 1.0], -0.1),
        ] {
            assert_eq!(DepthCodes::new(ends, shift, true), None, "{ends:?} {shift}");
        }
        assert!(DepthCodes::new([0.0, 1.0], 0.0, false).is_some());
    }

    const WHOLE: [(u16, u16); 9] = [
        (0, 10),
        (2, 12),
        (9, 20),
        (10, 22),
        (500, 638),
        (1234, 1767),
        (2047, 3383),
        (3000, 5917),
        (4095, 10000),
    ];
}
