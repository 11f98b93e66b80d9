//! Final choice of the model, after further folds if needed.

use taceva_core::ModelError;

use super::candidates::Candidate;
use super::entrant::Entrant;
use super::excess::{BEYOND_CHANCE, CLEARLY};
use super::race::{ALWAYS, Race};
use crate::linalg::progress::interrupted;
use crate::training::card::{AutoCard, FOLDS};

/// Assumed smallest ratio of the squared error of a network after complete training to its error after shortened training.
const GRANTED: f64 = 0.5;
/// Ratio of the squared error of a network to that of the best other model, below which the network can be chosen.
const WORTH: f64 = 0.95;
/// Ratio of the work of two models above which the costlier model must have a smaller error.
const DEARER: f64 = 10.0;

impl Race<'_> {
    /// Model with the least error among the remaining models, except networks. Two models are compared on the folds that both completed.
    pub(super) fn best(&self) -> Option<&Entrant> {
        let going = self.entrants.iter().filter(|own| own.left.is_none());
        going.reduce(|best, next| {
            let folds = best.losses.len().min(next.losses.len());
            match next.loss(folds) < best.loss(folds) {
                true => next,
                false => best,
            }
        })
    }

    /// True if the network is clearly better than all other models on the first fold.
    pub(super) fn network_leads(&self) -> bool {
        let network = self.network.last().filter(|own| own.left.is_none());
        network.is_some_and(|network| {
            let best = self.best();
            best.is_none_or(|best| is_ahead(network, best, CLEARLY))
        })
    }

    /// Trains the network completely on the first fold if the budget allows it. Skipped if the shortened training is clearly better or too far
    /// behind.
    pub(super) fn look_again(&mut self) -> Result<(), ModelError> {
        let Some((look, best)) = self.network.last().zip(self.best()) else {
            return Ok(());
        };
        let candidate = look.candidate;
        let is_behind = GRANTED * look.loss(1) > best.loss(1);
        let left = is_behind.then(|| {
            let best = best.name();
            format!("its squared error was more than twice that of {best}")
        });
        let is_over = is_behind || self.network_leads();
        self.network[0].left = left;
        if is_over || !self.affords(candidate.fold_s + candidate.fit_s) {
            return Ok(());
        }
        if let Ok(estimator) = (self.make)(candidate.info)? {
            let whole = self.first_fold(candidate, estimator, None)?;
            self.network.extend(whole);
        }
        Ok(())
    }

    /// Tries the other models on further folds until one model is left or the budget is spent.
    pub(super) fn more_folds(&mut self) -> Result<(), ModelError> {
        for fold in 1..FOLDS {
            self.thin_out();
            let going = self.entrants.iter().filter(|own| own.left.is_none());
            let work_s: f64 = going.map(|own| own.candidate.fold_s).sum();
            if self.is_decided() || !self.affords(work_s) {
                break;
            }
            let going = self.entrants.iter_mut().filter(|own| own.left.is_none());
            for own in going {
                interrupted(self.progress)?;
                let (training, progress) = (&self.training, self.progress);
                match self
                    .folds
                    .losses(fold, training, &*own.estimator, progress)?
                {
                    Ok(losses) => own.losses.push(losses),
                    Err(reason) => own.left = Some(reason),
                }
                own.spent_s += own.candidate.fold_s;
                self.spent_s += own.candidate.fold_s;
            }
        }
        self.thin_out();
        Ok(())
    }

    /// True if one model is left, or if the baseline and one clearly better model are left.
    fn is_decided(&self) -> bool {
        let going = self.entrants.iter().filter(|own| own.left.is_none());
        let going: Vec<&Entrant> = going.collect();
        match (self.best(), &going[..]) {
            (Some(best), [plain, _]) => {
                let is_clear = || {
                    let excess = plain.excess_over(best, best.losses.len());
                    excess.is_beyond(CLEARLY)
                };
                plain.name() == ALWAYS[0] && is_clear()
            }
            _ => going.len() < 2,
        }
    }

    /// Removes models that are clearly worse than the best model. Also removes models no better than a model with a tenth of their work. The baseline
    /// is never removed, because it costs nothing.
    fn thin_out(&mut self) {
        let Some(best) = self.best() else {
            return;
        };
        let folds = best.losses.len();
        let going = || self.entrants.iter().filter(|own| own.left.is_none());
        let why = |own: &Entrant| {
            if own.left.is_some() || own.name() == ALWAYS[0] {
                return None;
            }
            if own.excess_over(best, folds).is_beyond(CLEARLY) {
                return Some(format!("{} is clearly ahead", best.name()));
            }
            let does_as_well = |other: &&Entrant| {
                DEARER * other.candidate.fold_s < own.candidate.fold_s
                    && other.loss(folds) <= own.loss(folds)
            };
            let plainer = going().find(does_as_well)?.name();
            Some(format!(
                "{plainer} is as accurate with less than a tenth of the work"
            ))
        };
        let reasons: Vec<Option<String>> = self.entrants.iter().map(why).collect();
        for (own, reason) in self.entrants.iter_mut().zip(reasons) {
            own.left = own.left.take().or(reason);
        }
    }

    /// Chooses the baseline unless another model is significantly better. Chooses the network if it is significantly better than the best other
    /// model.
    pub(super) fn settle(&mut self) -> Option<Candidate> {
        let baseline = self.entrants.iter().find(|own| own.name() == ALWAYS[0]);
        let best = self.best().map(|best| {
            let is_chance = |plain: &&Entrant| {
                let folds = best.losses.len().min(plain.losses.len());
                !plain.excess_over(best, folds).is_beyond(BEYOND_CHANCE)
            };
            baseline.filter(is_chance).unwrap_or(best)
        });
        let network = self.network.last().filter(|own| own.left.is_none());
        let is_better =
            |network: &&Entrant| best.is_none_or(|best| is_ahead(network, best, BEYOND_CHANCE));
        if let Some(network) = network.filter(is_better) {
            return Some(network.candidate);
        }
        let taken = best.map(|best| best.candidate);
        if let (Some(taken), Some(network)) = (taken, self.network.last_mut()) {
            let ahead = || {
                let taken = taken.info.name;
                format!("not better than {taken} by more than chance and 5 % of its squared error")
            };
            network.left.get_or_insert_with(ahead);
        }
        taken
    }

    pub(super) fn card(self, taken: Candidate) -> AutoCard {
        let tried = self.entrants.iter().chain(&self.network);
        AutoCard {
            budget_s: self.budget_s,
            folds: FOLDS,
            by_group: self.folds.by_group,
            tried: tried.map(Entrant::trial).collect(),
            untried: self.untried,
            taken: taken.info.name.to_owned(),
        }
    }
}

/// True if `network` is better than `best` on the first fold. Its squared error must be smaller by 5 % and by more than `standard_errors` standard
/// errors.
fn is_ahead(network: &Entrant, best: &Entrant, standard_errors: f64) -> bool {
    let excess = best.excess_over(network, 1);
    network.loss(1) < WORTH * best.loss(1) && excess.is_beyond(standard_errors)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::estimators::registry::find;
    use crate::settings::ModelSettings;
    use crate::training::card::Untried;

    /// Builds a test model with `losses` on the units of the first fold. A trial on one fold takes `fold_s` s of work.
    fn entrant(name: &str, fold_s: f64, losses: [f64; 4]) -> Entrant {
        let info = find(name).expect("registered");
        let estimator = info.estimator(&ModelSettings::default());
        Entrant {
            candidate: Candidate {
                info,
                fold_s,
                fit_s: fold_s,
            },
            estimator: estimator.expect("valid"),
            losses: vec![losses.to_vec()],
            spent_s: fold_s,
            share: None,
            left: None,
        }
    }

    /// Builds a comparison after the first fold, with `entrants` and the trainings in `network`, and passes it to `then`.
    fn race_of(entrants: Vec<Entrant>, network: Vec<Entrant>, then: impl FnOnce(&mut Race<'_>)) {
        let samples = 8_u8;
        let shape = taceva_core::FeatureShape::flat(1);
        let features = vec![0.0; usize::from(samples)];
        let features = taceva_core::Features::new(shape, features).expect("whole samples");
        let channels = taceva_core::Channels::new([taceva_core::Channel::FZ]).expect("one");
        let labels: Vec<f64> = (0..samples).map(f64::from).collect();
        let targets = taceva_core::Targets::new(&channels, &labels);
        let training = taceva_core::TrainingSet::new(&features, targets);
        let mut race = Race {
            budget_s: 1e6,
            make: &|_| panic!("nothing is fitted"),
            folds: super::super::validate::Folds::new(&training, None),
            pictures: training,
            training,
            progress: &taceva_core::SilentProgress,
            spent_s: 0.0,
            entrants,
            network,
            untried: Vec::<Untried>::new(),
        };
        then(&mut race);
    }

    const PLAIN: [f64; 4] = [0.5, 0.7, 0.4, 0.6];

    fn taken(race: &mut Race<'_>) -> Option<&'static str> {
        race.settle().map(|taken| taken.info.name)
    }

    #[test]
    fn a_network_that_is_clearly_ahead_leads_and_is_taken() {
        let ahead = PLAIN.map(|loss| loss - 0.3);
        let models = vec![
            entrant("baseline", 0.0, [1.0, 0.9, 1.1, 1.0]),
            entrant("ridge", 0.1, PLAIN),
        ];
        race_of(models, vec![entrant("cnn", 60.0, ahead)], |race| {
            assert!(race.network_leads());
            assert_eq!(taken(race), Some("cnn"));
        });
    }

    #[test]
    fn a_network_that_is_ahead_by_chance_is_not_taken_and_the_card_says_of_whom() {
        let scattered = [0.1, 0.9, 0.2, 0.9];
        let models = vec![
            entrant("baseline", 0.0, [1.0, 0.9, 1.1, 1.0]),
            entrant("ridge", 0.1, PLAIN),
        ];
        race_of(models, vec![entrant("cnn", 60.0, scattered)], |race| {
            assert!(!race.network_leads());
            assert_eq!(taken(race), Some("ridge"));
            let left = race.network[0].left.as_deref();
            assert_eq!(
                left,
                Some("not better than ridge by more than chance and 5 % of its squared error")
            );
        });
    }

    #[test]
    fn a_network_that_is_ahead_by_a_hair_is_not_worth_its_work() {
        let hair = PLAIN.map(|loss| 0.99 * loss);
        let models = vec![entrant("ridge", 0.1, PLAIN)];
        race_of(models, vec![entrant("cnn", 60.0, hair)], |race| {
            let excess = race.entrants[0].excess_over(&race.network[0], 1);
            assert!(excess.is_beyond(CLEARLY));
            assert!(!race.network_leads());
            assert_eq!(taken(race), Some("ridge"));
        });
    }

    #[test]
    fn a_first_look_that_lags_far_behind_is_the_last() {
        let behind = PLAIN.map(|loss| 2.5 * loss);
        let models = vec![entrant("ridge", 0.1, PLAIN)];
        race_of(models, vec![entrant("cnn", 60.0, behind)], |race| {
            race.look_again().expect("nothing is fitted");
            assert_eq!(race.network.len(), 1);
            let left = race.network[0].left.as_deref().expect("said");
            assert_eq!(left, "its squared error was more than twice that of ridge");
        });
    }

    #[test]
    fn ten_times_the_work_must_do_better_and_what_is_clearly_behind_leaves() {
        let alike = [0.6, 0.6, 0.5, 0.6];
        let models = vec![
            entrant("baseline", 0.0, PLAIN.map(|loss| loss + 0.5)),
            entrant("ridge", 0.1, PLAIN),
            entrant("pls", 0.2, alike),
            entrant("random-forest", 8.0, alike),
            entrant("knn", 0.1, PLAIN.map(|loss| loss + 0.4)),
        ];
        race_of(models, Vec::new(), |race| {
            race.thin_out();
            let left = |at: usize| race.entrants[at].left.as_deref();
            assert_eq!(left(0), None, "the baseline stays");
            assert_eq!(left(1), None);
            assert_eq!(left(2), None);
            assert_eq!(
                left(3),
                Some("ridge is as accurate with less than a tenth of the work")
            );
            assert_eq!(left(4), Some("ridge is clearly ahead"));
            assert!(!race.is_decided());
            race.entrants[2].left = Some("out".to_owned());
            assert!(race.is_decided());
        });
    }

    #[test]
    fn what_is_better_than_the_baseline_by_chance_gives_way_to_it() {
        let models = vec![
            entrant("baseline", 0.0, [1.0, 0.9, 1.1, 1.0]),
            entrant("knn", 0.1, [0.6, 1.2, 0.7, 1.3]),
        ];
        race_of(models, Vec::new(), |race| {
            assert_eq!(race.best().map(Entrant::name), Some("knn"));
            assert_eq!(taken(race), Some("baseline"));
        });
    }
}
