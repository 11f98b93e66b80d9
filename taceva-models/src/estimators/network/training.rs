//! Training of networks, which can resume after an interruption.

use taceva_core::shown;
use taceva_core::{ErrorKind, ModelError, Progress};
use taceva_network::{Architecture, NetworkError, Recipe, Samples, Trained, Trainer};
use taceva_network::{Gpu, GpuError};

use crate::linalg::progress::{ReportedStage, interrupted};
use crate::training::checkpoint::Checkpoints;
use crate::training::checkpoint::{Identity, Shelf};

/// Inputs of one training run: architecture, settings, samples, device and checkpoints.
pub(super) struct Training<'a> {
    pub(super) architecture: &'a Architecture,
    pub(super) recipe: &'a Recipe,
    pub(super) samples: Samples<'a>,
    pub(super) validation: Option<Samples<'a>>,
    /// GPU for training; `None` for the CPU.
    pub(super) gpu: Option<&'a Gpu>,
    /// Checkpoints of the run; `None` if checkpoints are disabled.
    pub(super) checkpoints: Option<&'a Checkpoints>,
}

impl<'a> Training<'a> {
    /// Runs all remaining training steps, and reports progress after each step.
    pub(super) fn run(&self, progress: &dyn Progress) -> Result<Trained, ModelError> {
        let mut shelf = self.shelf();
        let (name, mut trainer) = self.begin(shelf.as_ref())?;
        let steps = usize::try_from(trainer.steps()).unwrap_or(usize::MAX);
        let stage = ReportedStage::begin(progress, name, steps);
        stage.advance_by(trainer.state().step);
        loop {
            if let Err(stopped) = interrupted(progress) {
                if let Some(shelf) = &mut shelf {
                    shelf.put(&trainer)?;
                }
                return Err(stopped);
            }
            match trainer.step() {
                Ok(Some(_)) => stage.advance(),
                Ok(None) => return trainer.finish().map_err(refused),
                Err(error) => return Err(broken(error, &trainer, shelf)),
            }
            if let Some(shelf) = &mut shelf {
                shelf.put_if_due(&trainer)?;
            }
        }
    }

    fn shelf(&self) -> Option<Shelf<'a>> {
        self.checkpoints.map(|checkpoints| {
            let kind = self.gpu.map(Gpu::kind);
            let identity = Identity::new(
                self.architecture,
                self.recipe,
                self.samples,
                self.validation,
                kind,
            );
            Shelf::new(checkpoints, identity)
        })
    }

    /// Resumes the training from its checkpoint, or starts a new training. Returns the stage name for progress reports, and the trainer.
    fn begin(&self, shelf: Option<&Shelf<'_>>) -> Result<(&'static str, Trainer<'a>), ModelError> {
        let (samples, validation) = (self.samples, self.validation);
        let found = shelf.map(Shelf::take).transpose()?.flatten();
        let (name, trainer) = match found {
            Some(found) => (
                "training resumed",
                Trainer::resume(found, samples, validation),
            ),
            None => (
                "training",
                Trainer::new(self.architecture, self.recipe, samples, validation),
            ),
        };
        let trainer = trainer.map_err(refused)?;
        let trainer = match self.gpu {
            None => trainer,
            Some(gpu) => {
                let engine = |snapshot: &_, recipe: &_| gpu.engine(snapshot, recipe);
                trainer.on(engine).map_err(refused)?
            }
        };
        Ok((name, trainer))
    }
}

/// Error for a training that failed, for example by a loss that is not finite. If there is a best epoch, it is saved as a checkpoint first.
fn broken(error: NetworkError, trainer: &Trainer<'_>, shelf: Option<Shelf<'_>>) -> ModelError {
    let refusal = refused(error);
    let Some((best, mut shelf)) = trainer.state().best.zip(shelf) else {
        return refusal;
    };
    let epoch = format!("the best epoch until then, {},", best + 1);
    let kept = match shelf.put(trainer) {
        Ok(()) => format!("{epoch} is saved in {}", shown(&shelf.path())),
        Err(problem) => format!("{epoch} could not be saved: {problem}"),
    };
    ModelError::new(refusal.kind(), format!("{refusal}; {kept}")).because(refusal)
}

/// Converts a network error to a model error.
pub(super) fn refused(error: NetworkError) -> ModelError {
    let kind = match error {
        NetworkError::LossNotFinite { .. }
        | NetworkError::WeightNotFinite { .. }
        | NetworkError::Memory { .. } => ErrorKind::OutOfRange,
        NetworkError::Device { .. } => ErrorKind::DeviceFault,
        _ => ErrorKind::InvalidArgument,
    };
    ModelError::new(kind, error.to_string()).because(error)
}

/// Converts a GPU error to a model error.
pub(super) fn no_gpu(error: GpuError) -> ModelError {
    let kind = match error {
        GpuError::NotFound { .. } => ErrorKind::NotFound,
        _ => ErrorKind::Unsupported,
    };
    ModelError::new(kind, error.to_string()).because(error)
}
