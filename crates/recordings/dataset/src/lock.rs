//! Exclusive lock of a folder for one writing process.

use std::fs::{File, TryLockError};
use std::path::Path;
use std::time::Duration;

use crate::error::DatasetError;

/// Number of attempts to lock a folder. A newly forked process keeps the locks of its parent until it executes another program.
const ATTEMPTS: u32 = 20;
const PAUSE: Duration = Duration::from_millis(5);

/// Locks a folder for this process. The system releases the lock when the process ends.
pub(crate) fn lock_folder(path: &Path) -> Result<File, DatasetError> {
    let folder = File::open(path).map_err(DatasetError::io("open", path))?;
    for _ in 0..ATTEMPTS {
        match folder.try_lock() {
            Ok(()) => return Ok(folder),
            Err(TryLockError::WouldBlock) => std::thread::sleep(PAUSE),
            Err(TryLockError::Error(source)) => {
                return Err(DatasetError::io("lock", path)(source));
            }
        }
    }
    Err(DatasetError::Busy {
        path: path.to_owned(),
    })
}
