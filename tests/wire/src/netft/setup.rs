//! Settings of an emulated Net F/T box: the page that shows them, and their effect on readings.

use std::time::Duration;

/// Settings of a Net F/T box, as a person makes them on its pages.
///
/// ```
/// use taceva_wire::netft::Setup;
/// let turned = Setup { tool: [0.0, 0.0, 0.0, 90.0, 0.0, 45.0], ..Setup::PLAIN };
/// assert_eq!(turned.filter, 0);
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Setup {
    /// Displacement and rotation of the tool frame about x, then y, then z, mm and degrees.
    pub tool: [f64; 6],
    /// Number of the low pass, at most 8; 0 for none.
    pub filter: u8,
    /// Drift of the force zero along the transducer's own z axis, N a minute.
    pub drift_n_min: f64,
    /// True if the page lacks the entries for the tool frame and the low pass filter.
    pub is_hidden: bool,
}

/// Names of the page's entries for the tool frame and the low pass filter.
const HIDDEN: [&str; 4] = ["cfgtfx", "scfgtdu", "scfgtau", "setuserfilter"];

/// Number of records that the box sends per second.
pub(super) const RATE_HZ: u32 = 500;
/// Number of measurements per second. The box sends only some of them.
pub(super) const INTERNAL_HZ: u32 = 7_000;
/// Counts per N, and per N·m.
pub(super) const COUNTS: f64 = 10_000_000.0;
/// Cutoffs of the low passes, from number 1, Hz.
const CUTOFFS_HZ: [f64; 8] = [838.0, 326.0, 152.0, 73.0, 35.0, 18.0, 8.0, 5.0];
/// Position of the tip relative to the transducer, in the transducer's axes, m.
const TIP_M: [f64; 3] = [0.002, -0.003, 0.05];
/// Measuring range of torques, N·m.
const RANGE_NM: f64 = 5.0;

impl Setup {
    /// A box without a tool frame, a low pass and drift.
    pub const PLAIN: Setup = Setup {
        tool: [0.0; 6],
        filter: 0,
        drift_n_min: 0.0,
        is_hidden: false,
    };

    /// The page `/netftapi2.xml` of a transducer with the serial number `serial`.
    pub(super) fn page(&self, serial: &str, range_n: f64) -> String {
        let tool = self.tool.map(|number| number.to_string()).join(";");
        let six_zeros = "0;0;0;0;0;0";
        let conditions = |value: &str| [value; 16].join(";");
        let range = [range_n, range_n, range_n, RANGE_NM, RANGE_NM, RANGE_NM];
        let entries = [
            ("runstat", "0x00000000".to_owned()),
            ("runft", six_zeros.to_owned()),
            ("runpkmx", six_zeros.to_owned()),
            ("runpkmn", six_zeros.to_owned()),
            ("runrate", INTERNAL_HZ.to_string()),
            ("runmcb", "0x00000000".to_owned()),
            ("runmco", "0x00".to_owned()),
            ("runmcl", "0".to_owned()),
            ("setcfgsel", "0".to_owned()),
            ("setuserfilter", self.filter.to_string()),
            ("setpke", "0".to_owned()),
            ("setbias", six_zeros.to_owned()),
            ("setmce", "0".to_owned()),
            // Unused thresholds.
            ("mce", conditions("0")),
            ("mcx", conditions("-1")),
            ("mcc", conditions("1")),
            ("mcv", conditions("0")),
            ("mco", conditions("0x00")),
            ("cfgnam", "Configuration &#35;1".to_owned()),
            ("cfgcalsel", "0".to_owned()),
            ("cfgcalsn", serial.to_owned()),
            ("cfgfu", "2".to_owned()),
            ("scfgfu", "N".to_owned()),
            ("cfgtu", "3".to_owned()),
            ("scfgtu", "Nm".to_owned()),
            ("cfgcpf", COUNTS.to_string()),
            ("cfgcpt", COUNTS.to_string()),
            ("cfgmr", range.map(|number| number.to_string()).join(";")),
            ("scfgtdu", "mm".to_owned()),
            ("scfgtau", "degrees".to_owned()),
            ("cfgtfx", tool),
            ("cfgusra", "empty".to_owned()),
            ("cfgusrb", "empty".to_owned()),
            ("nethwaddr", "02:00:00:00:00:00".to_owned()),
            ("netip", "127.0.0.1".to_owned()),
            ("comnetip", "127.0.0.1".to_owned()),
            ("comnetdhcp", "Disabled".to_owned()),
            ("comrdte", "Enabled".to_owned()),
            ("comrdtrate", RATE_HZ.to_string()),
            ("comrdtbsiz", "40".to_owned()),
            ("mfgdigsn", serial.to_owned()),
            ("mfgdigver", "2.2.59".to_owned()),
            ("prodname", "TACEVA-SIM".to_owned()),
        ];
        let shown = entries.into_iter();
        let shown = shown.filter(|(key, _)| !(self.is_hidden && HIDDEN.contains(key)));
        let entries: String = shown
            .map(|(key, value)| format!("<{key}>{value}</{key}>\r\n"))
            .collect();
        format!(
            "<?xml version=\"1.0\" encoding=\"ISO-8859-1\"?>\r\n<netft>\r\n{entries}</netft>\r\n"
        )
    }

    /// Wrench that the box reports, in N and N·m, for the force `force_n` on the tip. The force is in the transducer's own axes.
    pub(super) fn wrench(&self, force_n: [f64; 3]) -> [f64; 6] {
        let [x, y, z, turns @ ..] = self.tool;
        let from_tool_m = [
            TIP_M[0] - 1e-3 * x,
            TIP_M[1] - 1e-3 * y,
            TIP_M[2] - 1e-3 * z,
        ];
        let torque_nm = cross(from_tool_m, force_n);
        let [fx, fy, fz] = into_frame(force_n, turns);
        let [tx, ty, tz] = into_frame(torque_nm, turns);
        [fx, fy, fz, tx, ty, tz]
    }

    /// Adds the drift of the zero to a force in the transducer's own axes, N. `since` is the time since the start.
    pub(super) fn drifted_n(&self, [x, y, z]: [f64; 3], since: Duration) -> [f64; 3] {
        [x, y, z + self.drift_n_min / 60.0 * since.as_secs_f64()]
    }

    /// Output of the low pass filter for the input `wrench`, one reading after the output `before`.
    pub(super) fn passed(&self, before: [f64; 6], wrench: [f64; 6]) -> [f64; 6] {
        let number = usize::from(self.filter);
        let Some(cutoff_hz) = number
            .checked_sub(1)
            .and_then(|at| CUTOFFS_HZ.get(at).copied())
        else {
            return wrench;
        };
        let share = 1.0 - (-std::f64::consts::TAU * cutoff_hz / f64::from(RATE_HZ)).exp();
        std::array::from_fn(|at| before[at] + share * (wrench[at] - before[at]))
    }
}

fn cross([ax, ay, az]: [f64; 3], [bx, by, bz]: [f64; 3]) -> [f64; 3] {
    [ay * bz - az * by, az * bx - ax * bz, ax * by - ay * bx]
}

/// Components of `vector` in a frame that is rotated about x, then y, then z, by the angles `turns` in degrees.
fn into_frame(vector: [f64; 3], turns: [f64; 3]) -> [f64; 3] {
    let mut turned = vector;
    for (axis, degrees) in turns.into_iter().enumerate() {
        let (sin, cos) = degrees.to_radians().sin_cos();
        let (next, last) = ((axis + 1) % 3, (axis + 2) % 3);
        let before = turned;
        turned[next] = cos * before[next] + sin * before[last];
        turned[last] = cos * before[last] - sin * before[next];
    }
    turned
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_turned_frame_changes_components_and_no_magnitude() {
        let turned = Setup {
            tool: [0.0, 0.0, 0.0, 90.0, 0.0, 0.0],
            ..Setup::PLAIN
        };
        let [fx, fy, fz, ..] = turned.wrench([1.0, 2.0, 3.0]);
        for (found, expected) in [(fx, 1.0), (fy, 3.0), (fz, -2.0)] {
            assert!((found - expected).abs() < 1e-12, "{found} {expected}");
        }
        let [.., tx, ty, tz] = Setup::PLAIN.wrench([1.0, 2.0, 3.0]);
        assert!([tx, ty, tz].iter().all(|torque_nm| torque_nm.abs() > 1e-3));
    }

    #[test]
    fn a_zero_drifts_by_the_minute_and_a_page_may_hide_frame_and_low_pass() {
        let drifting = Setup {
            drift_n_min: 0.02,
            is_hidden: true,
            ..Setup::PLAIN
        };
        let [fx, _, fz] = drifting.drifted_n([1.0, 2.0, 3.0], Duration::from_secs(90));
        assert!((fx - 1.0).abs() < 1e-12 && (fz - 3.03).abs() < 1e-12);
        let [hidden, plain] = [drifting, Setup::PLAIN].map(|setup| setup.page("FT1", 50.0));
        for entry in HIDDEN {
            let entry = format!("<{entry}>");
            assert!(
                plain.contains(&entry) && !hidden.contains(&entry),
                "{entry}"
            );
        }
        assert!(hidden.contains("<cfgcalsn>FT1</cfgcalsn>"));
    }

    #[test]
    fn a_low_pass_comes_late_to_the_same_end() {
        let filtered = Setup {
            filter: 8,
            ..Setup::PLAIN
        };
        let (mut out, step) = ([0.0; 6], [1.0; 6]);
        for _ in 0..16 {
            out = filtered.passed(out, step);
        }
        // A time constant of a low pass of 5 Hz.
        assert!((0.5..0.75).contains(&out[2]), "{out:?}");
        let [plain, ..] = Setup::PLAIN.passed([0.0; 6], [0.1; 6]);
        assert!((plain - 0.1).abs() < 1e-12, "{plain}");
    }
}
