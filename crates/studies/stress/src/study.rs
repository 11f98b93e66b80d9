//! Stress test: the errors of a fitted model on the pictures or signals of a recording with faults.

use taceva_check::{FrameFacts, RestChange, Tiles};
use taceva_core::Frame;
use taceva_dataset::Dataset;
use taceva_evaluate::{EvaluateError, Target, Work, subject_of};
use taceva_models::Model;
use taceva_results::not_measured;

use crate::cells::{cells, levels};
use crate::estimate::{Estimate, Undefined};
use crate::fault::Fault;
use crate::faults::note_on;
use crate::findings::{CHANGED_REST, LOW, breaks_at, recovers, unnoticed};
use crate::list::list;
use crate::looks::codes;
use crate::notes::notes;
use crate::others::OtherFaults;
use crate::pass::UNTOUCHED;
use crate::report::{
    Basis, ByChannel, CleanScore, FaultReport, STRESS_SCHEMA, SeverityReport, SkippedFault,
    StressReport,
};
use crate::samples::shares;
use crate::scale::Scale;
use crate::score::{Scored, Scorer, degradation, mean_degradation};
use crate::setup::{Setup, StressRequest};
use crate::severity::{By, Levels};
use crate::stages::{Pictures, ScoredCell, Tested};
use crate::stress::Stress;
use crate::taxel_scores::TaxelTest;
use crate::worn::{NewGel, ScoredFault};

/// Measures the errors of `model` on the pictures or signals of `dataset` with faults. The model is not fitted again.
///
/// # Errors
/// [`EvaluateError`] if the request is not valid, the model does not suit the recording, or a picture cannot be read.
pub fn stress(
    dataset: &Dataset,
    model: &Model,
    request: &StressRequest,
    work: Work<'_>,
) -> Result<StressReport, EvaluateError> {
    stress_beside(dataset, model, request, OtherFaults::default(), work)
}

/// Same as [`stress`], with the faults in `others` after the faults of `request`. If `request` names no fault, only `others` are tested.
///
/// # Errors
/// Errors of [`stress`].
pub fn stress_beside(
    dataset: &Dataset,
    model: &Model,
    request: &StressRequest,
    others: OtherFaults<'_>,
    work: Work<'_>,
) -> Result<StressReport, EvaluateError> {
    let setup = Setup::new(dataset, model, request, others.is_some())?;
    measure(dataset, model, setup, request, others, work)
}

/// Same as [`stress_beside`] for the samples of `target`, which the caller knows to be unseen. The part in `request` is ignored.
///
/// # Errors
/// Errors of [`stress`].
pub fn stress_unseen(
    dataset: &Dataset,
    model: &Model,
    target: Target,
    request: &StressRequest,
    others: OtherFaults<'_>,
    work: Work<'_>,
) -> Result<StressReport, EvaluateError> {
    let setup = Setup::of_target(dataset, model, target, request, others.is_some())?;
    measure(dataset, model, setup, request, others, work)
}

fn measure(
    dataset: &Dataset,
    model: &Model,
    mut setup: Setup,
    request: &StressRequest,
    mut others: OtherFaults<'_>,
    work: Work<'_>,
) -> Result<StressReport, EvaluateError> {
    let taxels = setup.taxels(dataset, model)?;
    let mut request = request.clone();
    let scale = match &taxels {
        Some(taxels) => {
            // Only faults of pictures have a severity by stimulus.
            request.by = By::Parameter;
            let unseen = std::mem::take(&mut others.foreign).iter();
            let unseen = unseen.map(|fault| SkippedFault::unseen(*fault));
            setup.skipped.extend(unseen);
            Scale {
                contact: taxels.contact,
                ..Scale::default()
            }
        }
        None => Scale::of(dataset, &setup.samples.rows)?,
    };
    let request = &request;
    let markers = setup.markers(scale.untouched.as_ref());
    let levels = levels(&setup, &scale, markers.as_ref(), request)?;
    let cells = cells(&setup, &scale, markers.as_ref(), &levels, model, request);
    let shares = shares(dataset, &setup.samples.rows);
    let shares = shares.unwrap_or_else(|| vec![1.0; dataset.table().rows()]);
    let rows = &setup.samples.rows;
    let scorer = Scorer::new(
        dataset,
        model,
        &setup.samples.target,
        rows,
        &request.metrics,
        work.jobs,
    )?;
    let pictures = Pictures {
        dataset,
        model,
        rows,
        shares: &shares,
        reference: scale.reference(),
        scorer: &scorer,
        work,
    };
    let of_taxels = &setup.of_taxels;
    let test = taxels
        .as_ref()
        .map(|taxels| TaxelTest::of(dataset, model, rows, of_taxels, taxels, request, work));
    let test = test.transpose()?;
    let found = match (&test, request.stops_at_no_skill) {
        (Some(test), _) => Tested {
            clean: test.clean.clone(),
            passes: 1,
            ..Tested::default()
        },
        (None, true) => pictures.until_no_skill(cells)?,
        (None, false) => pictures.at_once(cells)?,
    };
    let baseline = scorer.score(&found.clean)?;
    let clean = scorer.clean(&baseline);
    let results = Results {
        scale: &scale,
        clean: &clean,
        found: &found,
        baseline: &baseline,
        dataset,
        rows: &setup.samples.rows,
        codes: codes(
            dataset,
            &setup.samples.rows,
            found.looks.iter(),
            scale.reference(),
        ),
    };
    let new = &NewGel {
        dataset,
        model,
        rows: &setup.samples.rows,
        scorer: &scorer,
        baseline: &baseline,
        clean: &clean,
        scale: &scale,
    };
    let of_labels = setup.of_labels.iter();
    let of_labels = of_labels.map(|&fault| new.by_labels(fault, &found.clean, request));
    let of_taxels = test.iter().flat_map(|test| {
        let faults = of_taxels.iter();
        faults.map(move |&fault| new.by_taxels(fault, test, request))
    });
    let of_rows = setup.of_rows.iter();
    let of_rows = of_rows.map(|&fault| new.by_rows(fault, request));
    let worn = others.worn.iter().map(|fault| new.beside(fault, work));
    let other_scores = of_labels.chain(of_taxels).chain(of_rows).chain(worn);
    let mut other_scores: Vec<ScoredFault> = other_scores.collect::<Result<_, EvaluateError>>()?;
    let mut failed = Vec::new();
    for fault in others.foreign {
        match new.foreign(*fault, &request.severities, work)? {
            Ok(scores) => other_scores.push(scores),
            Err(reason) => failed.push(SkippedFault {
                fault: fault.name().to_owned(),
                reason,
            }),
        }
    }
    let mut faults: Vec<FaultReport> = (0..setup.faults.len())
        .map(|fault| results.of_fault(fault, setup.faults[fault], &levels[fault]))
        .collect();
    let mean = results.mean(setup.faults.len(), &other_scores);
    let subject = subject_of(dataset);
    let again = (found.passes - 1) * setup.samples.rows.len() as u64;
    let decoded = other_scores.iter().map(|of| of.decoded).sum::<u64>() + scale.decoded + again;
    let provenance = setup.samples.provenance(dataset, model, decoded)?;
    let tested = setup.all();
    let mut skipped = setup.skipped;
    for of in other_scores {
        faults.push(of.report);
        skipped.extend(of.skipped);
    }
    Ok(StressReport {
        schema: STRESS_SCHEMA,
        not_measured: not_measured([subject.source.as_str()]),
        subject,
        by: request.by,
        list: list(&tested, request, others, !setup.leds.is_unknown()),
        seed: request.seed,
        draws: request.draws,
        samples: setup.samples.rows.len(),
        input: model.card().input.field().name(),
        left_out: setup.samples.left_out(),
        untouched: taxels.as_ref().map_or(scale.source(), |of| of.source),
        contact: scale.contact,
        contact_unit: taxels
            .as_ref()
            .map_or("1", |of| of.facts.info.unit.symbol()),
        units: scorer.units(&baseline),
        clean,
        mean,
        unnoticed: (scale.is_reference || taxels.is_some()).then(|| unnoticed(&faults)),
        notes: notes(&tested, request, &baseline, setup.samples.rows.len()),
        faults,
        skipped,
        failed,
        provenance,
        reference: None,
        basis: Basis {
            clean: baseline.errors.clone(),
            rows: setup.samples.rows,
        },
    })
}

/// Scores of all cells; a cell is one fault at one severity.
struct Results<'a> {
    scale: &'a Scale,
    clean: &'a ByChannel<CleanScore>,
    found: &'a Tested<'a>,
    baseline: &'a Scored,
    dataset: &'a Dataset,
    /// Scored rows.
    rows: &'a [usize],
    /// Codes of the checks that find something in the pictures without a fault.
    codes: Vec<&'static str>,
}

impl Results<'_> {
    /// Indices of the cells of the fault with the index `fault`.
    fn positions(&self, fault: usize) -> impl Iterator<Item = usize> {
        let positions = 0..self.found.cells.len();
        positions.filter(move |position| self.found.cells[*position].fault == fault)
    }

    fn of_fault(&self, fault: usize, of: &'static Fault, levels: &Levels) -> FaultReport {
        let scored = self.positions(fault).map(|at| &self.found.scored[at]);
        let scored: Vec<&ScoredCell> = scored.collect();
        let severities: Vec<SeverityReport> =
            self.positions(fault).map(|at| self.of_cell(at)).collect();
        let stale = |name: &str| {
            let cells = scored.iter().map(|cell| &cell.stale);
            degradation(name, cells, self.baseline)
        };
        let by_channel = |value: &dyn Fn(&str) -> Estimate| -> ByChannel<Estimate> {
            let names = self.baseline.names();
            names.map(|name| (name.clone(), value(name))).collect()
        };
        let has_fresh = scored.iter().all(|cell| cell.fresh.is_some()) && !scored.is_empty();
        FaultReport {
            id: of.id.to_owned(),
            title: of.title.to_owned(),
            parameter: of.parameter.to_owned(),
            note: match of.is_of_leds() {
                true => note_on(self.dataset.header().sensor.leds),
                false => of.note.map(str::to_owned),
            },
            mean: by_channel(&stale),
            recovers: by_channel(&|name: &str| match has_fresh {
                true => recovers(&severities, name, &stale(name)),
                false => Estimate::undefined(Undefined::NoFreshReference),
            }),
            breaks_at: {
                let names = self.baseline.names();
                let breaks = names.map(|name| (name.clone(), breaks_at(&severities, name)));
                breaks.collect()
            },
            stopped_at: {
                let last = severities.last().map(|of| of.severity);
                last.filter(|_| severities.len() < levels.reached.len())
            },
            relative_error: None,
            difference: None,
            times: ByChannel::new(),
            errors: scored.iter().map(|of| of.stale.errors.clone()).collect(),
            severities,
            unreached: levels.unreached.clone(),
        }
    }

    fn of_cell(&self, at: usize) -> SeverityReport {
        let (cell, scored) = (&self.found.cells[at], &self.found.scored[at]);
        let change = self.found.predicted[at].change(self.rows.len());
        let stimulus = self.scale.contact.map(|contact| change / contact);
        SeverityReport {
            severity: cell.level.severity,
            parameter: cell.level.parameter,
            stimulus,
            low_stimulus: stimulus.is_some_and(|stimulus| stimulus < LOW),
            check: self.check(at),
            stale: scored.stale.beside(self.baseline, self.clean),
            fresh: scored
                .fresh
                .as_ref()
                .map(|fresh| fresh.beside(self.baseline, self.clean)),
            times: ByChannel::new(),
        }
    }

    /// Codes of the checks that find the fault of cell `at` in every random draw, and find nothing without the fault.
    fn check(&self, at: usize) -> Vec<&'static str> {
        let draws = &self.found.cells[at].draws;
        let of_draw = |draw: usize| {
            let looks = self.found.predicted[at].looks.iter();
            let looks = looks.skip(draw).step_by(draws.len());
            codes(self.dataset, self.rows, looks, self.scale.reference())
        };
        let mut found = of_draw(0);
        found.retain(|code| !self.codes.contains(code));
        for draw in 1..draws.len() {
            let other = of_draw(draw);
            found.retain(|code| other.contains(code));
        }
        let is_noticed = draws.iter().all(|draw| self.is_noticed(&draw.stress));
        found.extend(is_noticed.then_some(CHANGED_REST));
        found
    }

    /// True if the check of untouched pictures finds the fault. It compares pictures of contact that also have the fault.
    fn is_noticed(&self, stress: &Stress<'_>) -> bool {
        let Some(reference) = self.scale.reference() else {
            return false;
        };
        let tiles = |frame: &Frame| FrameFacts::of(frame, None).tiles;
        let rest = tiles(&stress.apply(reference, UNTOUCHED, None));
        let pressed = self.scale.pressed.iter().enumerate();
        let pressed = pressed.map(|(number, frame)| {
            let sample = format!("pressed {number}");
            tiles(&stress.apply(frame, &sample, None))
        });
        let pressed: Vec<Tiles> = pressed.collect();
        let pressed: Vec<&Tiles> = pressed.iter().collect();
        let change = RestChange::of(&tiles(reference), &rest, &pressed);
        change.is_some_and(|change| change.is_overall() || change.is_local())
    }

    /// Degradation of each channel as a mean over all faults.
    fn mean(&self, faults: usize, others: &[ScoredFault]) -> ByChannel<Estimate> {
        let mean = |name: &String| {
            let of_fault = |fault| {
                let cells = self.positions(fault);
                let cells = cells.map(|at| &self.found.scored[at].stale);
                cells.collect::<Vec<&Scored>>()
            };
            let others = others.iter().map(|fault| fault.cells.iter().collect());
            mean_degradation(name, (0..faults).map(of_fault).chain(others), self.baseline)
        };
        let names = self.baseline.names();
        names.map(|name| (name.clone(), mean(name))).collect()
    }
}
