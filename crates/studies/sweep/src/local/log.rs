//! Log of a task: its stages and its outcome.

use std::fs::File;
use std::io::Write as _;
use std::sync::Mutex;

use taceva_core::Progress;

use super::lock;
use crate::folder::SweepFolder;
use crate::task::Task;

/// Writer of a task's log.
pub(super) struct TaskLog<'a> {
    file: Mutex<Option<File>>,
    whole: &'a dyn Progress,
}

impl<'a> TaskLog<'a> {
    pub(super) fn new(folder: &SweepFolder, task: &Task, whole: &'a dyn Progress) -> TaskLog<'a> {
        let path = folder.log(&task.key);
        // A link may lead to a file of another user, so the task then has no log.
        let is_link = std::fs::symlink_metadata(&path).is_ok_and(|found| found.is_symlink());
        let open = || File::options().create(true).append(true).open(&path).ok();
        let log = TaskLog {
            file: Mutex::new((!is_link).then(open).flatten()),
            whole,
        };
        let split = task.division();
        log.say(&format!(
            "task {} {} {} split {split} seed {}",
            task.key,
            task.dataset,
            task.title(),
            task.seed
        ));
        log
    }

    /// Adds a line; write errors are ignored.
    pub(super) fn say(&self, line: &str) {
        if let Some(file) = lock(&self.file).as_mut() {
            drop(writeln!(file, "{}", taceva_core::shown(line)));
        }
    }
}

impl Progress for TaskLog<'_> {
    fn begin(&self, stage: &str, steps: Option<u64>) {
        match steps {
            Some(steps) => self.say(&format!("{stage} ({steps})")),
            None => self.say(stage),
        }
    }

    fn is_cancelled(&self) -> bool {
        self.whole.is_cancelled()
    }

    fn is_insisted(&self) -> bool {
        self.whole.is_insisted()
    }
}
