//! Finds the results of tests with faults: files of `taceva stress`, and files of a run with `[stress]`.

use std::fs;
use std::path::{Path, PathBuf};

use anyhow::Context as _;
use taceva_core::shown;
use taceva_report::{FaultResult, Study};

use super::{RESULTS, file_of, read};

/// Folder of a run for results of tests with faults. Names in it begin with the number of the study.
const STRESS: &str = "stress";

/// Studies of all results, each with the result of its test with faults, if any. A file of `taceva stress` belongs to the study of the same sensor,
/// serial number, gel and origin. Without such a study, it becomes a study of its own.
pub(in crate::cmd) fn read_all_with_faults(named: &[PathBuf]) -> anyhow::Result<Vec<Study>> {
    let mut studies = Vec::new();
    let mut alone = Vec::new();
    for path in named {
        if let Some(faults) = of_file(path)? {
            alone.push(faults);
            continue;
        }
        let mut found = read(path)?;
        if path.exists() {
            let faults = of_run(&file_of(path)?, found.len())?;
            for (study, faults) in found.iter_mut().zip(faults) {
                study.faults = faults;
            }
        }
        studies.extend(found);
    }
    for faults in alone {
        add(&mut studies, Study::of_faults(faults));
    }
    Ok(studies)
}

/// Adds `tested`, the study of a `taceva stress` file, to the only study of the same subject, or as a new study to `studies`.
fn add(studies: &mut Vec<Study>, tested: Study) {
    let is_same = |at: &usize| {
        let own = &studies[*at];
        let own = [&own.sensor, &own.serial, &own.gel, &own.source];
        own == [&tested.sensor, &tested.serial, &tested.gel, &tested.source]
    };
    let same: Vec<usize> = (0..studies.len()).filter(is_same).collect();
    match same.as_slice() {
        [at] if studies[*at].faults.is_none() => studies[*at].faults = tested.faults,
        _ => studies.push(tested),
    }
}

/// Result of a test with faults in the file `path`; `None` if the file is another result.
fn of_file(path: &Path) -> anyhow::Result<Option<FaultResult>> {
    if !path.is_file() {
        return Ok(None);
    }
    let text = fs::read_to_string(path).with_context(|| format!("cannot read {}", shown(path)))?;
    let is_faults = FaultResult::is_in(&text);
    let faults = is_faults.then(|| FaultResult::read(&text));
    faults.transpose().with_context(|| shown(path).to_string())
}

/// Results of tests with faults, one for each of the `count` studies in the results `file`; `None` for a study without test.
fn of_run(file: &Path, count: usize) -> anyhow::Result<Vec<Option<FaultResult>>> {
    let folder = file.with_file_name(STRESS);
    let is_run = file.file_name().is_some_and(|name| name == RESULTS);
    let mut faults = vec![None; count];
    if !is_run || !folder.is_dir() {
        return Ok(faults);
    }
    let entries =
        fs::read_dir(&folder).with_context(|| format!("cannot read {}", shown(&folder)))?;
    for entry in entries {
        let path = entry?.path();
        let name = path.file_name().and_then(|name| name.to_str());
        let number = name.and_then(|name| {
            let (number, _) = name.strip_suffix(".json")?.split_once('-')?;
            number.parse::<usize>().ok()
        });
        let at = number.and_then(|number| number.checked_sub(1));
        if let Some(own) = at.and_then(|at| faults.get_mut(at)) {
            *own = of_file(&path)?;
        }
    }
    Ok(faults)
}

/// Results of tests with faults for the `count` studies of the result `path`, which is a file or the folder of a run.
pub(in crate::cmd) fn faults_of(
    path: &Path,
    count: usize,
) -> anyhow::Result<Vec<Option<FaultResult>>> {
    of_run(&file_of(path)?, count)
}
