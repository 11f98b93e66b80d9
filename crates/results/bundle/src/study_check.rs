//! Claims and other numbers of one study, compared with the recomputed numbers.

use taceva_evaluate::PredictionCheck;
use taceva_results::{EvaluationReport, Score};

use crate::claim::{Claim, Number, words};
use crate::level::Level;
use crate::origin;
use crate::recomputation::{FitScores, Recomputation, Stop, TableScores};
use crate::verification::{ClaimCheck, OtherCheck, Verdict};

/// Reason for a claim that is not in the results.
pub(crate) const NO_SUCH_NUMBER: &str = "results.json has no such number";

/// One study: its results in the bundle, and its results computed again.
pub(crate) struct StudyCheck<'a> {
    pub(crate) study: usize,
    pub(crate) report: &'a EvaluationReport,
    pub(crate) again: Recomputation,
    /// Deepest requested level.
    pub(crate) most: Level,
    /// Greatest difference between a claim and its recomputed number for the verdict `within`.
    pub(crate) tolerance: f64,
}

impl StudyCheck<'_> {
    /// Verdict on a claim of this study. A claim that states a deeper level than it reaches is not verified.
    pub(crate) fn claim(&self, claim: &Claim) -> ClaimCheck {
        let check = self.reached(claim);
        let stated = claim.level.min(self.most);
        if check.level >= stated || check.verdict == Verdict::Differs {
            return check;
        }
        let reason = format!(
            "bundle.json states the level {}, but the check reached only {}: {}",
            claim.level,
            check.level,
            check.reason.as_deref().unwrap_or("no files")
        );
        ClaimCheck {
            verdict: Verdict::NotRecomputable,
            reason: Some(reason),
            is_absent: false,
            ..check
        }
    }

    /// Verdict on a claim, as deep as the files allow.
    fn reached(&self, claim: &Claim) -> ClaimCheck {
        let mut check = ClaimCheck {
            study: claim.study,
            metric: claim.metric.clone(),
            channel: claim.channel.clone(),
            variant: claim.variant.clone(),
            stated: claim.value,
            recomputed: None,
            level: Level::Form,
            verdict: Verdict::Equal,
            reason: None,
            is_absent: false,
        };
        let named = claim.score_in(&self.report.scores);
        let Some(named) = named.filter(|score| claim.is_of(score)) else {
            return check.ended(Verdict::Differs, NO_SUCH_NUMBER.to_owned());
        };
        let in_results = Number::of(named, claim.variant.as_deref());
        let is_stated = in_results.is_some_and(|number| number.is_same(claim.number()));
        if !is_stated {
            let found =
                in_results.map_or_else(|| "no number".to_owned(), |found| found.to_string());
            check.verdict = Verdict::Differs;
            check.reason = Some(format!("results.json has {found}"));
        }
        if self.most < Level::Scores {
            return check;
        }
        let scores = match &self.again.states {
            Ok(state) => &state.scores,
            Err(stop) => return check.stopped(stop),
        };
        check = self.compared(check, claim, scores, Level::Scores);
        let is_done = matches!(check.verdict, Verdict::Differs | Verdict::NotRecomputable);
        if self.most < Level::Predictions || is_done {
            return check;
        }
        let check = match &self.again.tables {
            Ok(tables) => self.by_tables(check, claim, tables),
            Err(stop) => check.not_compared("tables", stop),
        };
        let is_compared = check.level == Level::Predictions
            && matches!(check.verdict, Verdict::Equal | Verdict::Within);
        let check = match self.most >= Level::Model && is_compared {
            true => self.by_model(check),
            false => check,
        };
        let is_compared = check.level == Level::Model
            && matches!(check.verdict, Verdict::Equal | Verdict::Within);
        match self.most >= Level::Fit && is_compared {
            true => self.by_fit(check, claim),
            false => check,
        }
    }

    /// Verdict on a claim that reached [`Level::Model`], after a repeated fit.
    fn by_fit(&self, mut check: ClaimCheck, claim: &Claim) -> ClaimCheck {
        let scores = match &self.again.fit {
            Ok(FitScores::Other(scores)) => scores,
            Ok(FitScores::Equal) => {
                check.level = Level::Fit;
                return check;
            }
            Err(stop) => return check.not_compared("a repeated fit", stop),
        };
        let score = claim.score_in(scores);
        let again = score.and_then(|score| Number::of(score, claim.variant.as_deref()));
        let (Some(again), Some([low, high])) = (again, claim.ci95) else {
            let reason = "the repeated fit gives another model, and the claim has no interval";
            return check.ended(Verdict::NotRecomputable, reason.to_owned());
        };
        check.level = Level::Fit;
        let (verdict, place) = match (low..=high).contains(&again.value) {
            true => (Verdict::Within, "within"),
            false => (Verdict::Differs, "outside"),
        };
        let reason = format!(
            "the repeated fit gives another model, whose {} is {place} the interval",
            again.value
        );
        check.ended(verdict, reason)
    }

    /// Verdict on a claim that reached [`Level::Predictions`], after the comparison of the tables with the model.
    fn by_model(&self, mut check: ClaimCheck) -> ClaimCheck {
        let found = match &self.again.model {
            Ok(found) => found,
            Err(stop) => return check.not_compared("the model", stop),
        };
        check.level = Level::Model;
        match found {
            PredictionCheck::Equal { .. } => check,
            PredictionCheck::Near { first, .. } => {
                let reason = format!("predictions differ on other instruction sets: {first}");
                check.ended(Verdict::Within, reason)
            }
            PredictionCheck::Differs(reason) => check.ended(Verdict::Differs, reason.clone()),
            _ => check.ended(Verdict::NotRecomputable, "not compared".to_owned()),
        }
    }

    /// The verdict on a claim after its comparison with the scores of tables.
    fn by_tables(&self, check: ClaimCheck, claim: &Claim, tables: &TableScores) -> ClaimCheck {
        let mut left_out = tables.left_out.iter();
        if let Some(skip) = left_out.find(|skip| skip.what == claim.metric) {
            return ClaimCheck {
                is_absent: true,
                reason: Some(format!("not compared with tables: {}", skip.reason)),
                ..check
            };
        }
        self.compared(check, claim, &tables.scores, Level::Predictions)
    }

    /// The verdict on a claim after its comparison with `scores`.
    fn compared(
        &self,
        mut check: ClaimCheck,
        claim: &Claim,
        scores: &[Score],
        level: Level,
    ) -> ClaimCheck {
        let from = match level {
            Level::Predictions => "the tables",
            _ => "the state",
        };
        let Some(score) = claim.score_in(scores) else {
            let reason = format!("{} is not in {from}", claim.words());
            return check.ended(Verdict::NotRecomputable, reason);
        };
        let own = claim.score_in(&self.report.scores).map(definition);
        let other = definition(score);
        if own.as_ref() != Some(&other) {
            let own = own.unwrap_or_default();
            let reason = format!("{own}, {from} has {other}");
            return check.ended(Verdict::NotRecomputable, reason);
        }
        let Some(again) = Number::of(score, claim.variant.as_deref()) else {
            let reason = format!("{} is undefined in {from}", claim.words());
            return check.ended(Verdict::Differs, reason);
        };
        let stated = claim.number();
        check.level = level;
        check.recomputed = Some(again.value);
        if !claim.is_of(score) {
            let reason = format!("{from} gives n = {}, expected {}", score.n, claim.n);
            return check.ended(Verdict::Differs, reason);
        }
        if stated.is_same(again) {
            return check;
        }
        if stated.is_within(again, self.tolerance) {
            check.verdict = match check.verdict {
                Verdict::Differs => Verdict::Differs,
                _ => Verdict::Within,
            };
            return check;
        }
        let reason = format!("printed {stated}, recomputed {again} from {from}");
        check.ended(Verdict::Differs, reason)
    }

    /// Differences of scores in facts that no claim states, and parts of the results that cannot be computed from a state.
    pub(crate) fn others(&self, claims: &[ClaimCheck]) -> Vec<OtherCheck> {
        let mut found = Vec::new();
        let other = |part: String, verdict, reason: &str| OtherCheck {
            study: self.study,
            part,
            verdict,
            reason: reason.to_owned(),
        };
        let Ok(state) = &self.again.states else {
            return found;
        };
        let states = state.scores.as_slice();
        for (part, reason) in origin::differences(self.report, state) {
            found.push(other(part.to_owned(), Verdict::Differs, &reason));
        }
        for score in states {
            let (metric, channel) = (score.metric.as_str(), score.channel.as_str());
            if self.report.score(metric, channel).is_none() {
                let part = words(metric, None, channel);
                let reason = "the state has this score, and results.json lacks it";
                found.push(other(part, Verdict::Differs, reason));
            }
        }
        let (tables, left_out) = match &self.again.tables {
            Ok(tables) => (tables.scores.as_slice(), tables.left_out.as_slice()),
            Err(_) => (Default::default(), Default::default()),
        };
        for score in &self.report.scores {
            let is_own = |claim: &&ClaimCheck| {
                claim.study == self.study
                    && claim.metric == score.metric
                    && claim.channel == score.channel
            };
            // Skips scores with a reported claim, so that no difference is reported twice.
            let is_said = |claim: &ClaimCheck| claim.verdict != Verdict::Equal;
            if claims.iter().filter(is_own).any(is_said) {
                continue;
            }
            let part = words(&score.metric, None, &score.channel);
            let is_left_out = left_out.iter().any(|skip| skip.what == score.metric);
            if !states.contains(score) {
                let reason = "the state gives another score, in more than its number";
                found.push(other(part, Verdict::Differs, reason));
            } else if !tables.is_empty() && !is_left_out && !tables.contains(score) {
                let reason = "the tables give another score, in more than its number";
                found.push(other(part, Verdict::Differs, reason));
            }
        }
        if self
            .again
            .tables
            .as_ref()
            .is_ok_and(|tables| tables.has_other_sums)
        {
            let reason = "the sums of the tables are not those of the state";
            found.push(other("state".to_owned(), Verdict::Differs, reason));
        }
        if let Ok(PredictionCheck::Differs(reason)) = &self.again.model {
            let reason = format!("the model gives other predictions: {reason}");
            found.push(other("predictions".to_owned(), Verdict::Differs, &reason));
        }
        let report = self.report;
        for (part, is_there) in [
            ("by_recording", !report.by_recording.is_empty()),
            ("by_group", !report.by_group.is_empty()),
            ("over_seeds", report.over_seeds.is_some()),
            ("tasks", !report.tasks.is_empty()),
        ] {
            if is_there {
                let reason = "no state holds these numbers";
                found.push(other(part.to_owned(), Verdict::NotRecomputable, reason));
            }
        }
        found
    }
}

impl ClaimCheck {
    fn ended(mut self, verdict: Verdict, reason: String) -> ClaimCheck {
        // A claim that is missing in the results differs, regardless of other findings.
        if self.verdict != Verdict::Differs || verdict == Verdict::Differs {
            self.verdict = verdict;
            self.reason = Some(reason);
        }
        self
    }

    /// The same claim, marked as not compared with `what`.
    fn not_compared(self, what: &str, stop: &Stop) -> ClaimCheck {
        ClaimCheck {
            is_absent: stop.is_absent,
            reason: Some(format!("not compared with {what}: {}", stop.reason)),
            verdict: match stop.is_absent {
                true => self.verdict,
                false => Verdict::NotRecomputable,
            },
            ..self
        }
    }

    fn stopped(mut self, stop: &Stop) -> ClaimCheck {
        self.is_absent = stop.is_absent;
        self.ended(Verdict::NotRecomputable, stop.reason.clone())
    }
}

/// Definition of a score with its constants: `mae/1 with gate 0.02`.
fn definition(score: &Score) -> String {
    let constants = score.parameters.iter();
    let constants: Vec<String> = constants
        .map(|(name, value)| format!("{name} {value}"))
        .collect();
    match constants.is_empty() {
        true => score.definition.clone(),
        false => format!("{} with {}", score.definition, constants.join(", ")),
    }
}

#[cfg(test)]
mod tests;
