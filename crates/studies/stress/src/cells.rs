//! Severities of the faults of pictures. A cell of the stress test is one fault at one severity.

use taceva_evaluate::EvaluateError;
use taceva_models::{MarkerTracker, Model};

use crate::fault::Scope;
use crate::pass::{Cell, compares};
use crate::scale::Scale;
use crate::setup::{Setup, StressRequest};
use crate::severity::{By, Levels, Reference};
use crate::stress::{Stress, draw_seeds};

/// Finds the parameter of each fault at each requested severity.
pub(crate) fn levels(
    setup: &Setup,
    scale: &Scale,
    markers: Option<&MarkerTracker>,
    request: &StressRequest,
) -> Result<Vec<Levels>, EvaluateError> {
    let faults = setup.faults.iter();
    if request.by == By::Parameter || setup.faults.is_empty() {
        let levels = faults.map(|fault| Levels::by_parameter(fault, &request.severities));
        return Ok(levels.collect());
    }
    let (Some(untouched), Some(contact)) = (&scale.untouched, scale.contact) else {
        return Err(EvaluateError::Request(
            "severity by stimulus: expected an untouched picture or labels of Fz or Pz, and pictures of contact that differ from the untouched \
             picture; use --by parameter"
                .to_owned(),
        ));
    };
    let reference = Reference {
        scale,
        untouched,
        contact,
        markers,
        leds: setup.leds,
        seed: request.seed,
        draws: request.draws,
    };
    let levels = faults.map(|&fault| Levels::by_stimulus(fault, &request.severities, &reference));
    Ok(levels.collect())
}

/// Creates one cell for each fault at each of its severities.
pub(crate) fn cells<'m>(
    setup: &Setup,
    scale: &Scale,
    markers: Option<&'m MarkerTracker>,
    levels: &[Levels],
    model: &Model,
    request: &StressRequest,
) -> Vec<Cell<'m>> {
    let reference = scale.reference().filter(|_| compares(model));
    let mut cells = Vec::new();
    for (position, &fault) in setup.faults.iter().enumerate() {
        let untouched = reference.filter(|_| fault.scope != Scope::Each);
        for level in &levels[position].reached {
            let seeds = draw_seeds(fault, request.seed, request.draws);
            let stresses = seeds.into_iter();
            let stresses = stresses.map(|seed| {
                let stress = Stress::new(fault, level.parameter, seed);
                stress.with_markers(markers).with_leds(setup.leds)
            });
            let stresses = stresses.collect();
            cells.push(Cell::new(position, *level, stresses, model, untouched));
        }
    }
    cells
}
