//! The recorder as a program that is started, cut off and started again, and what it must leave.

use std::num::NonZeroUsize;
use std::path::{Path, PathBuf};
use std::process::Command;

use taceva_core::{Frame, FrameInfo, PixelFormat, SilentProgress};
use taceva_dataset::{Dataset, DatasetError, Digest, Pass, Recorder};

use crate::binary::example;
use crate::drawn::scratch;

/// The recorder and the digests of what it records: sample `n` is the same in every recording.
#[derive(Debug)]
pub struct Recorded {
    program: PathBuf,
    /// Of the recording of the first `n` samples, for each `n`.
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

    /// Samples of the longest recording.
    pub fn most(&self) -> usize {
        self.digests.len() - 1
    }

    /// The recorder about to record everything in a new folder at `target`, or to go on there.
    pub fn command(&self, target: &Path) -> Command {
        let mut command = Command::new(&self.program);
        command.arg(target).arg(self.most().to_string());
        command
    }

    /// Opens what an interruption left at `target` and closes it: at least the first `acknowledged` samples must be there,
    /// whole, in order, each once, and nothing else.
    ///
    /// # Errors
    /// What is not as promised.
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
            // It was closed already.
            Err(DatasetError::TargetExists { .. }) => {}
            Err(DatasetError::NoDataset { .. }) if acknowledged == 0 => return Ok(()),
            Err(error) => return Err(format!("{acknowledged} acknowledged: {error}")),
        }
        self.check_closed(target, acknowledged)
    }

    /// The same of a recording that is closed.
    ///
    /// # Errors
    /// What is not as promised.
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

/// The dataset at `target`, after each of its frames was read, verified and decoded.
///
/// # Errors
/// What is wrong with it.
pub fn open_whole(target: &Path) -> Result<Dataset, String> {
    let dataset = Dataset::open(target).map_err(|error| error.to_string())?;
    let rows = dataset.all_rows();
    let pass = Pass::new(&rows, NonZeroUsize::MIN, &SilentProgress);
    dataset
        .map_frames(pass, |_, _| (), |_, ()| Ok(()))
        .map_err(|error| error.to_string())?;
    Ok(dataset)
}

/// A small frame in which each pixel is `shade`.
///
/// # Panics
/// Never: it has a byte for each pixel.
pub fn reference(shade: u8) -> Frame {
    let info = FrameInfo {
        width: 40,
        height: 30,
        format: PixelFormat::Gray8,
    };
    Frame::new(info, vec![shade; 1_200]).expect("a byte for each pixel")
}
