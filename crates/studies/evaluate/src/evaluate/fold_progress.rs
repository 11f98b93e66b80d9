//! Progress of one fold. The name of the fold precedes the name of each stage.

use taceva_core::Progress;

/// Progress of one fold.
pub(super) struct FoldProgress<'a> {
    progress: &'a dyn Progress,
    fold: String,
}

impl<'a> FoldProgress<'a> {
    /// Reports `model` and `fold`, such as `fold 2 of 5`, as a separate stage. Plain progress lines then always name the fold.
    pub(super) fn of(progress: &'a dyn Progress, model: &str, fold: String) -> FoldProgress<'a> {
        progress.begin(&format!("fit {model}, {fold}"), None);
        progress.end();
        FoldProgress { progress, fold }
    }
}

impl Progress for FoldProgress<'_> {
    fn begin(&self, stage: &str, steps: Option<u64>) {
        self.progress
            .begin(&format!("{}: {stage}", self.fold), steps);
    }

    fn advance(&self, steps: u64) {
        self.progress.advance(steps);
    }

    fn end(&self) {
        self.progress.end();
    }

    fn is_cancelled(&self) -> bool {
        self.progress.is_cancelled()
    }

    fn is_insisted(&self) -> bool {
        self.progress.is_insisted()
    }
}

#[cfg(test)]
mod tests {
    use std::sync::Mutex;

    use super::*;

    /// Test observer that stores the stages it receives.
    #[derive(Default)]
    struct Kept(Mutex<Vec<String>>);

    impl Kept {
        fn keep(&self, words: String) {
            self.0.lock().expect("one thread").push(words);
        }
    }

    impl Progress for Kept {
        fn begin(&self, stage: &str, steps: Option<u64>) {
            self.keep(format!("{stage} {steps:?}"));
        }

        fn advance(&self, steps: u64) {
            self.keep(format!("+{steps}"));
        }

        fn end(&self) {
            self.keep("end".to_owned());
        }

        fn is_cancelled(&self) -> bool {
            true
        }
    }

    #[test]
    fn a_fold_is_named_at_its_start_and_in_every_stage() {
        let kept = Kept::default();
        let fold = FoldProgress::of(&kept, "ridge", "fold 2 of 5".to_owned());
        fold.begin("features", Some(3));
        fold.advance(2);
        fold.end();
        assert!(fold.is_cancelled() && !fold.is_insisted());
        assert_eq!(
            *kept.0.lock().expect("one thread"),
            [
                "fit ridge, fold 2 of 5 None",
                "end",
                "fold 2 of 5: features Some(3)",
                "+2",
                "end"
            ]
        );
    }
}
