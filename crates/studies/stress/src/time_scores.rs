//! Metrics of the times of rows, such as the frame rate, after a fault has removed rows.

use taceva_evaluate::EvaluateError;

use crate::fault::Fault;
use crate::report::{ByChannel, SeverityReport};
use crate::setup::StressRequest;
use crate::severity::Levels;
use crate::stress::Stress;
use crate::times::time_scores;
use crate::worn::{NewGel, ScoredFault};

impl NewGel<'_> {
    /// Computes metrics of the times that remain after `fault` has removed rows. Errors of predictions are not computed.
    pub(crate) fn by_rows(
        &self,
        fault: &'static Fault,
        request: &StressRequest,
    ) -> Result<ScoredFault, EvaluateError> {
        let all = self.dataset.all_rows();
        let samples = self.dataset.table().samples();
        let mut severities = Vec::new();
        for level in Levels::by_parameter(fault, &request.severities).reached {
            let stress = Stress::new(fault, level.parameter, request.seed);
            let kept = all.iter().copied();
            let kept = kept.filter(|row| !stress.leaves_out(&samples[*row]));
            let kept: Vec<usize> = kept.collect();
            severities.push(SeverityReport {
                severity: level.severity,
                parameter: level.parameter,
                stimulus: None,
                low_stimulus: false,
                check: Vec::new(),
                stale: ByChannel::new(),
                fresh: None,
                times: time_scores(self.dataset, &kept)?,
            });
        }
        let words = [fault.id, fault.title, fault.parameter];
        let mut report = self.report(words, severities, &[]);
        report.note = fault.note.map(str::to_owned);
        report.times = time_scores(self.dataset, &all)?;
        for scores in [&mut report.mean, &mut report.recovers] {
            scores.clear();
        }
        report.breaks_at.clear();
        Ok(ScoredFault {
            report,
            cells: Vec::new(),
            skipped: Vec::new(),
            decoded: 0,
        })
    }
}
