//! Scores of a fault of labels. Predictions from unchanged pictures are compared with labels that have the fault.

use taceva_core::Column;
use taceva_core::random::fnv_1a;
use taceva_evaluate::EvaluateError;

use crate::fault::Fault;
use crate::labels::Labels;
use crate::report::{ByChannel, SeverityReport};
use crate::setup::StressRequest;
use crate::severity::Levels;
use crate::stress::Stress;
use crate::worn::{NewGel, ScoredFault};

impl NewGel<'_> {
    /// Scores of the predictions `predicted` from unchanged pictures against labels with `fault`. A fault that changes no labels gets no severities.
    pub(crate) fn by_labels(
        &self,
        fault: &'static Fault,
        predicted: &[f64],
        request: &StressRequest,
    ) -> Result<ScoredFault, EvaluateError> {
        let draws = Stress::new(fault, 0.0, request.seed).of_fault();
        let mut severities = Vec::new();
        let mut cells = Vec::new();
        let levels = Levels::by_parameter(fault, &request.severities);
        let change = fault.label_change().into_iter();
        for (label, level) in change.flat_map(|of| levels.reached.iter().map(move |at| (of, at))) {
            let truth = self.scorer.labels().map(|(channel, truth)| {
                let labels = Labels {
                    table: self.dataset.table(),
                    channel: *channel,
                    rows: self.rows,
                    truth,
                    draws: draws.of(fnv_1a(channel.name().as_bytes())),
                };
                (label.change)(&labels, level.parameter)
            });
            let truth: Vec<Column> = truth.collect();
            let stale = self.scorer.with_labels(truth).score(predicted)?;
            severities.push(SeverityReport {
                severity: level.severity,
                parameter: level.parameter,
                stimulus: None,
                low_stimulus: false,
                check: Vec::new(),
                stale: stale.beside(self.baseline, self.clean),
                fresh: None,
                times: ByChannel::new(),
            });
            cells.push(stale);
        }
        let words = [fault.id, fault.title, fault.parameter];
        let mut report = self.report(words, severities, &cells);
        report.note = fault.note.map(str::to_owned);
        Ok(ScoredFault {
            report,
            cells,
            skipped: Vec::new(),
            decoded: 0,
        })
    }
}
