//! How the sessions of a recording on a real rig began: a table beside it, to which each session adds a row before its first press.

use std::fs::{self, File};
use std::io;
use std::path::{Path, PathBuf};

use serde::{Deserialize, Serialize};
use taceva_core::Specimen;
use taceva_drivers::MonotonicClock;
use taceva_protocol::{Plan, ReferenceTouch, SessionRecord};

use crate::error::StudyError;

/// A row of the table. Lengths in mm and forces in N, in the frame of the sensor.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
struct Row {
    /// The boot of the machine whose clock stamps the samples of the session; empty where the machine does not say.
    boot_id: String,
    /// When the session began by that clock, in s.
    begun_s: f64,
    unit: String,
    specimen: String,
    height_mm: f64,
    depth_mm: f64,
    #[serde(rename = "Fz_N")]
    fz_n: f64,
    #[serde(rename = "zero_Fx_N")]
    zero_fx_n: f64,
    #[serde(rename = "zero_Fy_N")]
    zero_fy_n: f64,
    #[serde(rename = "zero_Fz_N")]
    zero_fz_n: f64,
    x_felt: bool,
    y_felt: bool,
    picture_changed: bool,
    reaction_ms: f64,
    overshoot_mm: f64,
}

impl Row {
    fn of(record: &SessionRecord) -> Row {
        let [zero_fx_n, zero_fy_n, zero_fz_n] = record.zero.force.map(|force| force.0);
        let [x_felt, y_felt] = record.pushes_felt;
        Row {
            boot_id: boot_id(),
            begun_s: MonotonicClock.now_s(),
            unit: record.touch.unit.clone(),
            specimen: record.touch.specimen.to_string(),
            height_mm: record.touch.height_mm,
            depth_mm: record.touch.depth_mm,
            fz_n: record.touch.force_n,
            zero_fx_n,
            zero_fy_n,
            zero_fz_n,
            x_felt,
            y_felt,
            picture_changed: record.picture_changed,
            reaction_ms: record.reaction_ms,
            overshoot_mm: record.overshoot_mm,
        }
    }
}

/// The table beside the recording at `path`.
pub(crate) struct Sessions {
    path: PathBuf,
    rows: Vec<Row>,
}

impl Sessions {
    /// Reads what earlier sessions wrote; nothing where there was none.
    ///
    /// # Errors
    /// [`StudyError::Tables`] if it is there and no such table.
    pub(super) fn of(recording: &Path) -> Result<Sessions, StudyError> {
        let path = place(recording);
        let refused = |problem: String| StudyError::Tables {
            path: path.clone(),
            problem,
        };
        let rows = match File::open(&path) {
            Err(error) if error.kind() == io::ErrorKind::NotFound => Vec::new(),
            Err(error) => return Err(refused(error.to_string())),
            Ok(file) => {
                let mut table = csv::Reader::from_reader(file);
                let rows: Result<Vec<Row>, csv::Error> = table.deserialize().collect();
                rows.map_err(|error| {
                    refused(format!(
                        "{error}; expected the table of sessions that `taceva run` wrote: put it back, or begin another recording"
                    ))
                })?
            }
        };
        Ok(Sessions { path, rows })
    }

    /// What they touched, of specimens that `plan` still presses with.
    pub(super) fn touched(&self, plan: &Plan) -> Vec<ReferenceTouch> {
        let specimen = |written: &str| -> Option<Specimen> {
            let mut specimens = plan.presses.iter().map(|press| press.press.specimen);
            specimens.find(|specimen| specimen.to_string() == written)
        };
        let touches = self.rows.iter().filter_map(|row| {
            Some(ReferenceTouch {
                unit: row.unit.clone(),
                specimen: specimen(&row.specimen)?,
                height_mm: row.height_mm,
                depth_mm: row.depth_mm,
                force_n: row.fz_n,
            })
        });
        touches.collect()
    }

    /// Adds a session; durable when this returns.
    ///
    /// # Errors
    /// Those of the file system.
    pub(super) fn add(&mut self, record: &SessionRecord) -> io::Result<()> {
        self.rows.push(Row::of(record));
        let mut name = std::ffi::OsString::from(".");
        name.push(self.path.file_name().unwrap_or_default());
        name.push(".partial");
        let beside = self.path.with_file_name(name);
        taceva_files::replace(&self.path, &beside, |beside| {
            let mut table = csv::Writer::from_path(beside)?;
            self.rows.iter().try_for_each(|row| table.serialize(row))?;
            table.flush()
        })
    }
}

/// The sessions on a real rig in which a recording was made.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct RecordedSessions {
    /// How many boots of the machine stamped its samples: each has a clock that begins anew.
    pub boots: usize,
    /// What reports say of them.
    pub note: String,
}

/// The sessions of the recording at `path`, if it was made in some and their table is beside it still.
pub(crate) fn recorded_in(path: &Path) -> Option<RecordedSessions> {
    let note = note(path)?;
    let rows = Sessions::of(path).ok()?.rows;
    let mut boots: Vec<&str> = rows.iter().map(|row| row.boot_id.as_str()).collect();
    boots.sort_unstable();
    boots.dedup();
    Some(RecordedSessions {
        boots: boots.len(),
        note,
    })
}

/// A note on the recording at `path`, if it was made in sessions on a real rig.
pub(crate) fn note(path: &Path) -> Option<String> {
    // A recording that was moved has left the table behind.
    let rows = Sessions::of(path).ok()?.rows;
    let first = rows.first()?;
    let spread = |of: fn(&Row) -> f64| {
        let alike = rows
            .iter()
            .filter(|row| (&row.unit, &row.specimen) == (&first.unit, &first.specimen));
        let values = alike.map(of);
        let (least, greatest) = values.fold(
            (f64::INFINITY, f64::NEG_INFINITY),
            |(least, greatest), value| (least.min(value), greatest.max(value)),
        );
        greatest - least
    };
    let sessions = match rows.len() {
        1 => "1 session".to_owned(),
        count => format!(
            "{count} sessions, between which the gel began within {:.3} mm and pressed within {:.4} N at one depth",
            spread(|row| row.height_mm),
            spread(|row| row.fz_n)
        ),
    };
    let unseen: Vec<&str> = [
        ("Fx", rows.iter().all(|row| row.x_felt)),
        ("Fy", rows.iter().all(|row| row.y_felt)),
        ("the picture", rows.iter().all(|row| row.picture_changed)),
    ]
    .into_iter()
    .filter_map(|(what, is_seen)| (!is_seen).then_some(what))
    .collect();
    let unseen = match unseen[..] {
        [] => String::new(),
        _ => format!("; of {} the gentle touch showed nothing", unseen.join(", ")),
    };
    Some(format!("recorded in {sessions}{unseen}"))
}

fn place(recording: &Path) -> PathBuf {
    let mut name = recording.file_name().unwrap_or_default().to_owned();
    name.push(".sessions.csv");
    recording.with_file_name(name)
}

/// Names the boot of this machine, on Linux: stamps of two boots are of two clocks.
fn boot_id() -> String {
    let read = fs::read_to_string("/proc/sys/kernel/random/boot_id");
    read.map_or_else(|_| String::new(), |text| text.trim().to_owned())
}

#[cfg(test)]
mod tests {
    use taceva_core::{Nanometre, Newton, Wrench};

    use super::*;

    fn record(height_mm: f64, force_n: f64) -> SessionRecord {
        let mut zero = Wrench::default();
        zero.force[2] = Newton(0.3);
        SessionRecord {
            touch: ReferenceTouch {
                unit: "a, with \"quotes\"".to_owned(),
                specimen: Specimen::Sphere {
                    radius: Nanometre(4_000_000),
                },
                height_mm,
                depth_mm: 0.2,
                force_n,
            },
            zero,
            pushes_felt: [true, false],
            picture_changed: true,
            reaction_ms: 6.5,
            overshoot_mm: 0.02,
        }
    }

    #[test]
    fn what_a_session_writes_the_next_one_reads_and_the_report_says() {
        let folder = tempfile::tempdir().expect("a folder");
        let recording = folder.path().join("1-gel");
        assert_eq!(note(&recording), None);
        let mut sessions = Sessions::of(&recording).expect("none yet");
        sessions.add(&record(0.1, 0.06)).expect("written");
        let said = note(&recording).expect("one");
        assert_eq!(
            said,
            "recorded in 1 session; of Fy the gentle touch showed nothing"
        );
        let mut sessions = Sessions::of(&recording).expect("one");
        assert_eq!(sessions.rows[0].unit, "a, with \"quotes\"");
        sessions.add(&record(0.14, 0.0615)).expect("written");
        let said = note(&recording).expect("two");
        let expected =
            "2 sessions, between which the gel began within 0.040 mm and pressed within 0.0015 N";
        assert!(said.contains(expected), "{said}");
        let text = fs::read_to_string(place(&recording)).expect("there");
        assert!(
            text.starts_with("boot_id,begun_s,unit,specimen,height_mm,depth_mm,Fz_N,zero_Fx_N")
        );
        assert_eq!(text.lines().count(), 3);
    }

    #[test]
    fn a_table_that_is_none_is_refused_by_name_and_by_what_helps() {
        let folder = tempfile::tempdir().expect("a folder");
        let recording = folder.path().join("1-gel");
        fs::write(place(&recording), "boot_id,begun_s\nx,soon\n").expect("written");
        let error = Sessions::of(&recording).map(|_| ()).expect_err("no table");
        let said = error.to_string();
        assert!(
            said.contains("1-gel.sessions.csv") && said.contains("put it back"),
            "{said}"
        );
    }
}
