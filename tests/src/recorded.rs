//! Runs the recorder as a separate program that tests interrupt and restart, and checks its recordings.

use std::num::NonZeroUsize;
use std::path::{Path, PathBuf};
use std::process::Command;

use taceva_core::{Frame, FrameInfo, PixelFormat, SilentProgress};
use taceva_dataset::{Dataset, DatasetError, Digest, Pass, Recorder};

use crate::binary::example;
use crate::drawn::scratch;

/// Program that records, and digests of its uninterrupted recordings. Sample `n` is the same in every recording.
#[derive(Debug)]
pub struct Recorded {
    program: PathBuf,
    /// Digest of the recording of the first `n` samples, for each `n`.
    digests: Vec<Digest>,
}

impl Recorded {
    /// Records 0, 1, … `most` samples without interruption.
    ///
    /// # Panics
    /// If the recorder fails, which ends the test.
    pub fn up_to(most: usize) -> Recorded {
        let program = example("record");
        let digests = (0..=most)
            .map(|count| uninterrupted(&program, count))
            .collect();
        Recorded { program, digests }
    }

    /// Number of samples of the longest recording.
    pub fn most(&self) -> usize {
        self.digests.len() - 1
    }

    /// Command that records all samples in a new folder at `target`, or resumes an interrupted recording there.
    pub fn command(&self, target: &Path) -> Command {
        let mut command = Command::new(&self.program);
        command.arg(target).arg(self.most().to_string());
        command
    }

    /// Resumes and closes an interrupted recording at `target`. The first `acknowledged` samples at least must be present: complete, in
    /// order, each once, and nothing else.
    ///
    /// # Errors
    /// Description of a broken promise.
    pub fn check(&self, target: &Path, acknowledged: usize) -> Result<(), String> {
        let resumed = if target.exists() {
            Recorder::resume(target)
        } else {
            Err(DatasetError::NoDataset {
                path: target.to_owned(),
                problem: "no folder".to_owned(),
            })
        };
        match resumed {
            Ok(recorder) => {
                recorder.close().map_err(|error| error.to_string())?;
            }
            // The recording was closed already.
            Err(DatasetError::TargetExists { .. }) => {}
            Err(DatasetError::NoDataset { .. }) if acknowledged == 0 => return Ok(()),
            Err(error) => return Err(format!("{acknowledged} acknowledged: {error}")),
        }
        self.check_closed(target, acknowledged)
    }

    /// Like [`check`](Recorded::check), for a closed recording.
    ///
    /// # Errors
    /// Description of a broken promise.
    pub fn check_closed(&self, target: &Path, acknowledged: usize) -> Result<(), String> {
        let dataset = open_whole(target)?;
        let found = dataset.table().rows();
        if found < acknowledged {
            return Err(format!("{acknowledged} acknowledged, {found} recovered"));
        }
        match self.digests.get(found) {
            Some(expected) if *expected == dataset.digest() => Ok(()),
            expected => Err(format!(
                "{found} samples with digest {}, expected {expected:?}",
                dataset.digest()
            )),
        }
    }
}

fn uninterrupted(program: &Path, count: usize) -> Digest {
    let folder = scratch();
    let target = folder.path().join("recording");
    let mut command = Command::new(program);
    command.arg(&target).arg(count.to_string());
    let output = command.output().expect("the recorder was built");
    assert!(output.status.success(), "{output:?}");
    let dataset = open_whole(&target).expect("a recording that nobody interrupted");
    assert_eq!(dataset.table().rows(), count);
    dataset.digest()
}

/// Opens the dataset at `target`, and reads, verifies and decodes every frame.
///
/// # Errors
/// Description of the fault.
pub fn open_whole(target: &Path) -> Result<Dataset, String> {
    let dataset = Dataset::open(target).map_err(|error| error.to_string())?;
    let rows = dataset.all_rows();
    let pass = Pass::new(&rows, NonZeroUsize::MIN, &SilentProgress);
    dataset
        .map_frames(pass, |_, _| (), |_, ()| Ok(()))
        .map_err(|error| error.to_string())?;
    Ok(dataset)
}

/// A small frame in which every pixel is `shade`.
///
/// # Panics
/// Never: the number of bytes matches.
pub fn reference(shade: u8) -> Frame {
    let info = FrameInfo {
        width: 40,
        height: 30,
        format: PixelFormat::Gray8,
    };
    Frame::new(info, vec![shade; 1_200]).expect("a byte for each pixel")
}
