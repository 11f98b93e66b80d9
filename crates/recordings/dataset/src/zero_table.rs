//! Table of the zeros of the transducer in a recording on a real rig. Each press adds a row.

use std::collections::BTreeMap;
use std::fs::{self, OpenOptions};
use std::io::{self, Read, Seek, SeekFrom, Write};
use std::path::{Path, PathBuf};

use serde::{Deserialize, Serialize};

/// Zero of the transducer, which is its reading without contact, before and after a press. Components are in the coordinate frame of the sensor.
#[doc(hidden)]
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct PressZero {
    /// Id of the press.
    pub press: String,
    /// False if the zero changed too far, so that the press was discarded.
    pub is_kept: bool,
    /// Time of the zero after the press, on the clock of the samples, s.
    pub t_s: f64,
    /// Zero before the press along x, N.
    #[serde(rename = "before_Fx_N")]
    pub before_fx_n: f64,
    /// Zero before the press along y, N.
    #[serde(rename = "before_Fy_N")]
    pub before_fy_n: f64,
    /// Zero before the press along z, N.
    #[serde(rename = "before_Fz_N")]
    pub before_fz_n: f64,
    /// Zero after the press along x, N.
    #[serde(rename = "after_Fx_N")]
    pub after_fx_n: f64,
    /// Zero after the press along y, N.
    #[serde(rename = "after_Fy_N")]
    pub after_fy_n: f64,
    /// Zero after the press along z, N.
    #[serde(rename = "after_Fz_N")]
    pub after_fz_n: f64,
}

impl PressZero {
    fn before_n(&self) -> [f64; 3] {
        [self.before_fx_n, self.before_fy_n, self.before_fz_n]
    }

    /// Greatest change of a component during the press, N.
    fn change_n(&self) -> f64 {
        let after_n = [self.after_fx_n, self.after_fy_n, self.after_fz_n];
        let changes = self.before_n().into_iter().zip(after_n);
        changes.fold(0.0, |most: f64, (before, after)| {
            most.max((after - before).abs())
        })
    }
}

/// Adds a row to the table beside the recording at `recording`. A symbolic link at its name is replaced.
///
/// # Errors
/// Errors of the file system.
#[doc(hidden)]
pub fn add_press_zero(recording: &Path, zero: &PressZero) -> io::Result<()> {
    let path = place(recording);
    if fs::symlink_metadata(&path).is_ok_and(|found| found.is_symlink()) {
        fs::remove_file(&path)?;
    }
    let mut options = OpenOptions::new();
    let mut file = options.read(true).append(true).create(true).open(&path)?;
    let is_empty = file.metadata()?.len() == 0;
    let mut last = [b'\n'];
    if !is_empty {
        file.seek(SeekFrom::End(-1))?;
        file.read_exact(&mut last)?;
    }
    if last != [b'\n'] {
        // The new row begins on its own line after a truncated row.
        file.write_all(b"\n")?;
    }
    let mut table = csv::WriterBuilder::new()
        .has_headers(is_empty)
        .from_writer(file);
    table.serialize(zero)?;
    table.flush()
}

/// Rows of the table beside the recording at `recording`; empty without a table. A row that cannot be parsed is skipped, such as a row that a crash
/// truncated.
#[doc(hidden)]
pub fn press_zeros(recording: &Path) -> Vec<PressZero> {
    let table = csv::Reader::from_path(place(recording));
    let rows = table.map(|table| table.into_deserialize().filter_map(Result::ok).collect());
    rows.unwrap_or_default()
}

/// Changes of the zero over the kept presses of a recording.
struct ZeroChanges {
    /// Greatest change of a component during a press, N.
    step_n: f64,
    /// Greatest range of a component of the zeros before the presses, N.
    range_n: f64,
    /// Number of presses that were repeated because the zero changed too far.
    discarded: usize,
}

impl ZeroChanges {
    /// Changes in the table beside the recording at `recording`; `None` without a kept press.
    fn of(recording: &Path) -> Option<ZeroChanges> {
        let rows = press_zeros(recording);
        let kept = || rows.iter().filter(|row| row.is_kept);
        let first_n = kept().next()?.before_n();
        let ranges_n = (0..3).map(|axis| {
            let zeros = kept().map(|row| row.before_n()[axis]);
            let ends = (first_n[axis], first_n[axis]);
            let (least, most) = zeros.fold(ends, |(least, most), zero| {
                (zero.min(least), zero.max(most))
            });
            most - least
        });
        Some(ZeroChanges {
            step_n: kept().map(PressZero::change_n).fold(0.0, f64::max),
            range_n: ranges_n.fold(0.0, f64::max),
            discarded: rows.len() - kept().count(),
        })
    }
}

/// Changes of the zero as settings of the recording at `recording`; empty without a kept press.
#[doc(hidden)]
pub fn zero_settings(recording: &Path) -> BTreeMap<String, String> {
    let changes = ZeroChanges::of(recording).into_iter();
    let settings = changes.flat_map(|changes| {
        [
            ("force_zero_step_N", format!("{:.4}", changes.step_n)),
            ("force_zero_range_N", format!("{:.4}", changes.range_n)),
            ("force_zero_repeated_presses", changes.discarded.to_string()),
        ]
    });
    settings
        .map(|(name, value)| (name.to_owned(), value))
        .collect()
}

/// Clause about the zeros for the report; `None` without a kept press.
pub(crate) fn zeros_clause(recording: &Path) -> Option<String> {
    let ZeroChanges {
        step_n,
        range_n,
        discarded,
    } = ZeroChanges::of(recording)?;
    let discarded = match discarded {
        0 => String::new(),
        1 => "; 1 press was repeated because the zero changed further".to_owned(),
        presses => format!("; {presses} presses were repeated because the zero changed further"),
    };
    Some(format!(
        "the zero of the transducer changed by at most {step_n:.4} N during a press, and by {range_n:.4} N between the presses{discarded}"
    ))
}

fn place(recording: &Path) -> PathBuf {
    let mut name = recording.file_name().unwrap_or_default().to_owned();
    name.push(".zeros.csv");
    recording.with_file_name(name)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn zero(press: &str, is_kept: bool, before_n: f64, after_n: f64) -> PressZero {
        PressZero {
            press: press.to_owned(),
            is_kept,
            t_s: 2.0,
            before_fx_n: 0.0,
            before_fy_n: 0.0,
            before_fz_n: before_n,
            after_fx_n: 0.001,
            after_fy_n: 0.0,
            after_fz_n: after_n,
        }
    }

    #[test]
    fn zeros_of_several_sittings_stand_in_one_table_and_a_row_that_is_cut_off_is_left_out() {
        let folder = tempfile::tempdir().expect("a folder");
        let recording = folder.path().join("1-gel");
        assert_eq!(zeros_clause(&recording), None);
        assert!(zero_settings(&recording).is_empty());
        let rows = [
            zero("a", true, 7.5, 7.503),
            zero("b", false, 7.51, 7.8),
            zero("b", true, 7.8, 7.8),
        ];
        for row in &rows {
            add_press_zero(&recording, row).expect("written");
        }
        let text = fs::read_to_string(place(&recording)).expect("there");
        assert!(
            text.starts_with("press,is_kept,t_s,before_Fx_N,before_Fy_N,before_Fz_N,after_Fx_N")
        );
        assert_eq!(text.lines().count(), 4);
        fs::write(place(&recording), format!("{text}c,true,3.0,0.")).expect("written");
        assert_eq!(press_zeros(&recording), rows);
        assert_eq!(
            zeros_clause(&recording).as_deref(),
            Some(
                "the zero of the transducer changed by at most 0.0030 N during a press, and by 0.3000 N between the presses; 1 press was repeated because the zero changed further"
            )
        );
        // The settings state the numbers of the clause.
        let expected = [
            ("force_zero_range_N", "0.3000"),
            ("force_zero_repeated_presses", "1"),
            ("force_zero_step_N", "0.0030"),
        ];
        let expected = expected.map(|(name, value)| (name.to_owned(), value.to_owned()));
        assert_eq!(zero_settings(&recording), BTreeMap::from(expected));
        add_press_zero(&recording, &rows[0]).expect("written");
        assert_eq!(press_zeros(&recording).len(), 4);
    }

    #[cfg(unix)]
    #[test]
    fn a_link_at_the_name_of_the_table_is_replaced_and_leads_nothing_elsewhere() {
        let folder = tempfile::tempdir().expect("a folder");
        let (recording, theirs) = (folder.path().join("1-gel"), folder.path().join("theirs"));
        fs::write(&theirs, "5").expect("written");
        std::os::unix::fs::symlink(&theirs, place(&recording)).expect("linked");
        add_press_zero(&recording, &zero("a", true, 7.5, 7.503)).expect("written");
        assert_eq!(press_zeros(&recording).len(), 1);
        assert_eq!(fs::read_to_string(&theirs).expect("there"), "5");
    }
}
