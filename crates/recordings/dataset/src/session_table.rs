//! Table of the sessions of a recording on a real rig. Each session adds a row before its first press.

use std::fs::File;
use std::io;
use std::path::{Path, PathBuf};

use serde::{Deserialize, Serialize};

use crate::error::{DatasetError, Place};
use crate::zero_table::zeros_clause;

/// Start of a session, one row of the table. Before the first press, a test presses the gel gently (the gentle touch). Lengths are in mm and forces
/// in N, in the coordinate frame of the sensor.
#[doc(hidden)]
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Session {
    /// Boot id of the machine whose clock stamps the samples; empty if unknown.
    pub boot_id: String,
    /// Start of the session on the clock of the machine, s.
    pub begun_s: f64,
    /// Name of the sensor unit.
    pub unit: String,
    /// Name of the specimen of the gentle touch.
    pub specimen: String,
    /// Height at which the gel surface was found, mm.
    pub height_mm: f64,
    /// Depth of the gentle touch, mm.
    pub depth_mm: f64,
    /// Normal force of the gentle touch, N.
    #[serde(rename = "Fz_N")]
    pub fz_n: f64,
    /// Force reading at rest along x, N.
    #[serde(rename = "zero_Fx_N")]
    pub zero_fx_n: f64,
    /// Force reading at rest along y, N.
    #[serde(rename = "zero_Fy_N")]
    pub zero_fy_n: f64,
    /// Force reading at rest along z, N.
    #[serde(rename = "zero_Fz_N")]
    pub zero_fz_n: f64,
    /// True if the transducer measured a push along x.
    pub x_felt: bool,
    /// True if the transducer measured a push along y.
    pub y_felt: bool,
    /// True if the gentle touch changed the picture.
    pub picture_changed: bool,
    /// Delay between the force reading and the halt of the robot, ms.
    pub reaction_ms: f64,
    /// Travel of the tip after the halt, mm.
    pub overshoot_mm: f64,
    /// Standard uncertainty of `height_mm`, mm; `None` in sessions of builds that did not store it.
    #[serde(default)]
    pub height_u_mm: Option<f64>,
    /// Standard uncertainty of `fz_n` at `depth_mm`, N; `None` in sessions of builds that did not store it.
    #[serde(default, rename = "Fz_u_N")]
    pub fz_u_n: Option<f64>,
}

/// Table of sessions beside a recording.
#[doc(hidden)]
#[derive(Debug)]
pub struct SessionTable {
    path: PathBuf,
    rows: Vec<Session>,
}

impl SessionTable {
    /// Reads the table beside the recording at `recording`; empty without a session.
    ///
    /// # Errors
    /// [`DatasetError::Text`] for an invalid file.
    pub fn of(recording: &Path) -> Result<SessionTable, DatasetError> {
        let path = place(recording);
        let refused = |problem: String| DatasetError::Text {
            place: Place::file(&path),
            problem,
        };
        let rows = match File::open(&path) {
            Err(error) if error.kind() == io::ErrorKind::NotFound => Vec::new(),
            Err(error) => return Err(refused(error.to_string())),
            Ok(file) => {
                let mut table = csv::Reader::from_reader(file);
                let rows: Result<Vec<Session>, csv::Error> = table.deserialize().collect();
                rows.map_err(|error| {
                    refused(format!(
                        "{error}; expected the table of sessions that `taceva run` wrote: restore it, or begin another recording"
                    ))
                })?
            }
        };
        Ok(SessionTable { path, rows })
    }

    /// Rows of the table, the first session first.
    pub fn rows(&self) -> &[Session] {
        &self.rows
    }

    /// Adds a session, which is durable on return.
    ///
    /// # Errors
    /// Errors of the file system.
    pub fn add(&mut self, session: Session) -> io::Result<()> {
        self.rows.push(session);
        taceva_files::replace(&self.path, |staged| {
            let mut table = csv::Writer::from_path(staged)?;
            self.rows.iter().try_for_each(|row| table.serialize(row))?;
            table.flush()
        })
    }
}

/// Summary of the sessions on a real rig that made a recording.
#[doc(hidden)]
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct RecordedSessions {
    /// Number of boots of the machine that stamped the samples. Each boot restarts the clock.
    pub boots: usize,
    /// Sentence about the sessions, for reports.
    pub note: String,
}

impl RecordedSessions {
    /// Sessions of the recording at `path`; `None` without a table beside it.
    pub fn of(path: &Path) -> Option<RecordedSessions> {
        let rows = SessionTable::of(path).ok()?.rows;
        let zeros = zeros_clause(path).map(|clause| format!("; {clause}"));
        let note = note(&rows)? + &zeros.unwrap_or_default();
        let mut boots: Vec<&str> = rows.iter().map(|row| row.boot_id.as_str()).collect();
        boots.sort_unstable();
        boots.dedup();
        Some(RecordedSessions {
            boots: boots.len(),
            note,
        })
    }
}

/// Sentence about the sessions for reports; `None` without rows, as after a recording was moved without its table.
fn note(rows: &[Session]) -> Option<String> {
    let first = rows.first()?;
    let spread = |of: fn(&Session) -> f64| {
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
            "{count} sessions; between them the surface of the gel varied by {:.3} mm and the force at one depth by {:.4} N",
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
        _ => format!(
            "; the gentle touch showed no change of {}",
            unseen.join(", ")
        ),
    };
    Some(format!("recorded in {sessions}{unseen}"))
}

fn place(recording: &Path) -> PathBuf {
    let mut name = recording.file_name().unwrap_or_default().to_owned();
    name.push(".sessions.csv");
    recording.with_file_name(name)
}

#[cfg(test)]
mod tests {
    use std::fs;

    use super::*;

    fn session(height_mm: f64, fz_n: f64) -> Session {
        Session {
            boot_id: "boot".to_owned(),
            begun_s: 1.0,
            unit: "a, with \"quotes\"".to_owned(),
            specimen: "sphere 4 mm".to_owned(),
            height_mm,
            depth_mm: 0.2,
            fz_n,
            zero_fx_n: 0.0,
            zero_fy_n: 0.0,
            zero_fz_n: 0.3,
            x_felt: true,
            y_felt: false,
            picture_changed: true,
            reaction_ms: 6.5,
            overshoot_mm: 0.02,
            height_u_mm: Some(0.01),
            fz_u_n: Some(0.002),
        }
    }

    fn note(recording: &Path) -> Option<String> {
        RecordedSessions::of(recording).map(|sessions| sessions.note)
    }

    #[test]
    fn what_a_session_writes_the_next_one_reads_and_the_report_says() {
        let folder = tempfile::tempdir().expect("a folder");
        let recording = folder.path().join("1-gel");
        assert_eq!(note(&recording), None);
        let mut sessions = SessionTable::of(&recording).expect("none yet");
        sessions.add(session(0.1, 0.06)).expect("written");
        let said = note(&recording).expect("one");
        assert_eq!(
            said,
            "recorded in 1 session; the gentle touch showed no change of Fy"
        );
        let mut sessions = SessionTable::of(&recording).expect("one");
        assert_eq!(sessions.rows[0].unit, "a, with \"quotes\"");
        sessions.add(session(0.14, 0.0615)).expect("written");
        let said = note(&recording).expect("two");
        let expected = "2 sessions; between them the surface of the gel varied by 0.040 mm and the force at one depth by 0.0015 N";
        assert!(said.contains(expected), "{said}");
        let text = fs::read_to_string(place(&recording)).expect("there");
        assert!(
            text.starts_with("boot_id,begun_s,unit,specimen,height_mm,depth_mm,Fz_N,zero_Fx_N")
        );
        assert_eq!(text.lines().count(), 3);
    }

    #[test]
    fn a_table_without_the_columns_of_uncertainty_is_read_and_continued() {
        let folder = tempfile::tempdir().expect("a folder");
        let recording = folder.path().join("1-gel");
        let mut table = SessionTable::of(&recording).expect("none yet");
        table.add(session(0.1, 0.06)).expect("written");
        let text = fs::read_to_string(place(&recording)).expect("there");
        let lines = text.lines().map(|line| {
            let (rest, _) = line.rsplit_once(',').expect("Fz_u_N");
            let (rest, _) = rest.rsplit_once(',').expect("height_u_mm");
            format!("{rest}\n")
        });
        let earlier: String = lines.collect();
        assert!(earlier.contains(",overshoot_mm\n"), "{earlier}");
        fs::write(place(&recording), earlier).expect("written");
        let mut table = SessionTable::of(&recording).expect("an earlier build wrote it");
        assert_eq!(table.rows[0].height_u_mm, None);
        table.add(session(0.14, 0.0615)).expect("written");
        let rows = SessionTable::of(&recording).expect("both").rows;
        let stated: Vec<Option<f64>> = rows.iter().map(|row| row.fz_u_n).collect();
        assert_eq!(stated, [None, Some(0.002)]);
        assert!(note(&recording).is_some_and(|said| said.contains("2 sessions")));
    }

    #[test]
    fn a_table_that_is_none_is_refused_by_name_and_by_what_helps() {
        let folder = tempfile::tempdir().expect("a folder");
        let recording = folder.path().join("1-gel");
        fs::write(place(&recording), "boot_id,begun_s\nx,soon\n").expect("written");
        let error = SessionTable::of(&recording)
            .map(|_| ())
            .expect_err("no table");
        let said = error.to_string();
        assert!(
            said.contains("1-gel.sessions.csv") && said.contains("restore it"),
            "{said}"
        );
    }
}
