//! Tests that move a training from one engine to another.

use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};

use crate::common::small::{architecture, recipe, sums, values};
use taceva_network::{Batch, ConvolutionForm, Engine, Moments, Network, NetworkError, Trainer};

/// Engine that computes nothing and sets a flag on drop.
#[derive(Debug)]
struct Watched(Network, Arc<AtomicBool>);

impl Drop for Watched {
    fn drop(&mut self) {
        self.1.store(true, Ordering::Relaxed);
    }
}

impl Engine for Watched {
    fn step(&mut self, _: &Batch<'_>) -> Result<f64, NetworkError> {
        Ok(0.0)
    }

    fn predict(&mut self, _: &[f32], _: &mut [f64]) -> Result<(), NetworkError> {
        Ok(())
    }

    fn network(&self) -> Result<Network, NetworkError> {
        Ok(self.0.clone())
    }

    fn moments(&self) -> Result<Moments, NetworkError> {
        Ok(Moments::new())
    }
}

#[test]
fn an_engine_that_is_left_is_gone_before_the_next_one_takes_its_room() {
    let training = sums(1, 64);
    let trainer = Trainer::new(&architecture(), &recipe(), values(&training), None);
    let is_gone = Arc::new(AtomicBool::new(false));
    let watched = trainer
        .expect("a training")
        .on(|snapshot, _| Ok(Box::new(Watched(snapshot.network.clone(), is_gone.clone()))));
    let next = watched.expect("an engine").on(|snapshot, _| {
        assert!(is_gone.load(Ordering::Relaxed), "both take room at once");
        Ok(Box::new(Watched(snapshot.network.clone(), Arc::default())))
    });
    next.expect("an engine")
        .in_form(ConvolutionForm::Direct)
        .expect("room");
}
