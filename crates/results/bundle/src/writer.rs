//! Writer of the files of a bundle.

use std::collections::BTreeSet;
use std::fs::{self, File};
use std::io::Write as _;
use std::path::Path;

use taceva_evaluate::PredictionFiles;
use taceva_files::seal::digest_of_bytes;
use taceva_files::{parent_of, sync_folder};

use crate::error::BundleError;
use crate::inputs::StudyInputs;
use crate::layout::{FRAMES, FRAMES_ROLE, MODEL_ROLE, MOST_MODEL, MOST_TABLE, MOST_TEXT};
use crate::manifest::{BundledFile, StudyFiles, TableFiles, Withheld};
use crate::source::digest_of;

/// Writer of the files of a bundle.
pub(crate) struct Writer<'a> {
    pub(crate) root: &'a Path,
    pub(crate) files: Vec<BundledFile>,
}

impl<'a> Writer<'a> {
    /// Writer into the empty folder `root`.
    pub(crate) fn new(root: &'a Path) -> Writer<'a> {
        Writer {
            root,
            files: Vec::new(),
        }
    }

    /// Written files, sorted by path.
    pub(crate) fn sorted(&self) -> Vec<BundledFile> {
        let mut files = self.files.clone();
        files.sort_by(|one, other| one.path.cmp(&other.path));
        files
    }

    /// Writes a new file.
    pub(crate) fn add(&mut self, name: &str, role: &str, bytes: &[u8]) -> Result<(), BundleError> {
        let path = self.root.join(name);
        let folder = parent_of(&path);
        fs::create_dir_all(folder).map_err(BundleError::file(folder))?;
        let written = File::create_new(&path).and_then(|mut file| {
            file.write_all(bytes)?;
            file.sync_all()
        });
        written.map_err(BundleError::file(&path))?;
        self.files.push(BundledFile {
            path: name.to_owned(),
            size: bytes.len() as u64,
            sha256: digest_of_bytes(bytes),
            role: role.to_owned(),
        });
        Ok(())
    }

    /// Writes a value as JSON.
    pub(crate) fn json(
        &mut self,
        name: &str,
        role: &str,
        value: &impl serde::Serialize,
    ) -> Result<(), BundleError> {
        let text = serde_json::to_string_pretty(value)
            .map_err(|error| BundleError::input(Path::new(name), error.to_string()))?;
        self.add(name, role, format!("{text}\n").as_bytes())
    }

    /// Copies the file at `from`, of at most `most` bytes.
    fn copy(&mut self, name: &str, role: &str, from: &Path, most: u64) -> Result<(), BundleError> {
        let about = fs::metadata(from).map_err(BundleError::file(from))?;
        if !about.is_file() || about.len() > most {
            let remedy = match role {
                "state" => "score fewer metrics by --metrics",
                MODEL_ROLE => "leave the model out",
                _ => "leave tables out by --without predictions",
            };
            let problem = format!(
                "{} bytes, expected a regular file of at most {most}; {remedy}",
                about.len()
            );
            return Err(BundleError::input(from, problem));
        }
        let bytes = fs::read(from).map_err(BundleError::file(from))?;
        self.add(name, role, &bytes)
    }

    /// Copies the files of `recording` into the new folder `folder`, block by block.
    fn recording(&mut self, folder: &str, recording: &PredictionFiles) -> Result<(), BundleError> {
        for file in &recording.files {
            let (from, name) = (recording.folder.join(file), format!("{folder}/{file}"));
            let path = self.root.join(&name);
            let parent = parent_of(&path);
            fs::create_dir_all(parent).map_err(BundleError::file(parent))?;
            let copied = fs::copy(&from, &path).and_then(|size| {
                File::open(&path)?.sync_all()?;
                Ok(size)
            });
            self.files.push(BundledFile {
                path: name,
                size: copied.map_err(BundleError::file(&from))?,
                sha256: digest_of(&path)?,
                role: FRAMES_ROLE.to_owned(),
            });
        }
        Ok(())
    }

    /// Copies the files of study `number`, or states the digests of its tables.
    pub(crate) fn study(
        &mut self,
        number: usize,
        study: &StudyInputs,
        is_without_tables: bool,
        withheld: &mut Vec<Withheld>,
    ) -> Result<StudyFiles, BundleError> {
        let mut files = StudyFiles::default();
        for (position, from) in study.states.iter().enumerate() {
            let name = match position {
                0 => format!("states/{number}.json"),
                position => format!("states/{number}-{position}.json"),
            };
            self.copy(&name, "state", from, MOST_TEXT)?;
            files.states.push(name);
        }
        if let Some(from) = &study.model {
            let name = format!("model/{number}.taceva");
            self.copy(&name, MODEL_ROLE, from, MOST_MODEL)?;
            files.model = Some(name);
        }
        withheld.extend(study.withheld_model());
        for (position, recording) in study.frames.iter().enumerate() {
            let folder = match position {
                0 => format!("{FRAMES}/{number}"),
                position => format!("{FRAMES}/{number}-{position}"),
            };
            self.recording(&folder, recording)?;
            files.frames.push(folder);
        }
        withheld.extend(study.withheld_frames());
        if is_without_tables {
            let tables = study.tables.iter();
            let tables = tables
                .flat_map(|tables| [("truth", &tables.truth), ("prediction", &tables.prediction)]);
            let samples = study.samples.iter().map(|samples| ("samples", samples));
            for (role, from) in tables.chain(samples) {
                withheld.push(Withheld {
                    role: role.to_owned(),
                    reason: "left out by --without predictions".to_owned(),
                    digest: digest_of(from)?,
                });
            }
            return Ok(files);
        }
        if let Some(tables) = &study.tables {
            let [truth, prediction] =
                [("truth", &tables.truth), ("prediction", &tables.prediction)]
                    .map(|(role, from)| format!("tables/{role}.{}", ending(from)));
            self.copy(&truth, "truth", &tables.truth, MOST_TABLE)?;
            self.copy(&prediction, "prediction", &tables.prediction, MOST_TABLE)?;
            files.tables = Some(TableFiles {
                truth,
                prediction,
                key: tables.key.clone(),
            });
        }
        if let Some(from) = &study.samples {
            let name = format!("tables/samples-{number}.csv");
            self.copy(&name, "samples", from, MOST_TABLE)?;
            files.samples = Some(name);
        }
        Ok(files)
    }

    /// Syncs the names of all files to disk.
    pub(crate) fn sync(&self) -> Result<(), BundleError> {
        let root = self.root;
        let folders = self.files.iter().flat_map(|file| {
            let above = Path::new(&file.path).ancestors().skip(1);
            above.map(move |folder| root.join(folder))
        });
        for folder in folders.collect::<BTreeSet<_>>() {
            sync_folder(&folder).map_err(BundleError::file(&folder))?;
        }
        Ok(())
    }
}

/// File extension of the copy of a table: `parquet`, else `csv`.
fn ending(path: &Path) -> &'static str {
    let is_parquet = path
        .extension()
        .is_some_and(|own| own.eq_ignore_ascii_case("parquet"));
    if is_parquet { "parquet" } else { "csv" }
}
