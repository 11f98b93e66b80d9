//! Change of brightness and error from the reference scene to another lighting scene.

use super::sums::SceneSums;
use crate::exact::Dyadic;
use crate::score::value::{Finished, UndefinedReason};

/// Brightness I and mean absolute error MAE of a scene (c) and of the reference scene (o), each at least 0.
#[derive(Clone, Copy, Debug)]
pub(super) struct Change {
    pub(super) intensity: [f64; 2],
    pub(super) error: [f64; 2],
}

/// Relative change of brightness below which a scene says little about robustness.
const LOW_STIMULUS: f64 = 0.05;

impl Change {
    pub(super) fn between(scene: &SceneSums, reference: &SceneSums) -> Change {
        Change {
            intensity: [scene.mean_intensity(), reference.mean_intensity()],
            error: [scene.mean_error(), reference.mean_error()],
        }
    }

    /// Robustness R = a / (a + b), rounded once, with a = |Ic/Io − 1| and b = |MAEc/MAEo − 1|.
    ///
    /// I is the brightness and MAE the mean absolute error, in the lighting scene c and the reference scene o.
    pub(super) fn robustness(self) -> Finished {
        self.share(|difference| {
            if difference.is_negative() {
                -difference
            } else {
                difference
            }
        })
    }

    /// Robustness R = a / (a + b), with a = |Ic/Io − 1| and b = max(0, MAEc/MAEo − 1): a smaller error does not reduce the robustness.
    ///
    /// I is the brightness and MAE the mean absolute error, in the lighting scene c and the reference scene o.
    pub(super) fn robustness_plus(self) -> Finished {
        self.share(|difference| {
            if difference.is_negative() {
                Dyadic::from(0)
            } else {
                difference
            }
        })
    }

    /// Robustness |Ic − Io| MAEo / (|Ic − Io| MAEo + b Io), rounded once. `counted` computes b from MAEc − MAEo.
    ///
    /// I is the brightness and MAE the mean absolute error, in the lighting scene c and the reference scene o.
    fn share(self, counted: impl Fn(Dyadic) -> Dyadic) -> Finished {
        let [scene_intensity, intensity] = self.intensity.map(Dyadic::from_f64);
        let [scene_error, error] = self.error.map(Dyadic::from_f64);
        if intensity.is_zero() {
            return Err(UndefinedReason::ZeroIntensity);
        }
        if error.is_zero() {
            return Err(UndefinedReason::ZeroBaseline);
        }
        let brighter = &scene_intensity - &intensity;
        let brighter = if brighter.is_negative() {
            -brighter
        } else {
            brighter
        };
        let light = &brighter * &error;
        let harm = &counted(&scene_error - &error) * &intensity;
        let both = &light + &harm;
        if both.is_zero() {
            return Err(UndefinedReason::NoChange);
        }
        Ok(light.over(&both))
    }

    /// Ratios of brightness and of mean absolute error, scene over reference scene; `None` for an undefined ratio.
    pub(super) fn ratios(self) -> [Option<f64>; 2] {
        let ratio = |[scene, reference]: [f64; 2]| (reference > 0.0).then_some(scene / reference);
        [ratio(self.intensity), ratio(self.error)]
            .map(|ratio| ratio.filter(|ratio| ratio.is_finite()))
    }

    /// True if the brightness differs by less than 5 % from the reference scene.
    pub(super) fn is_low_stimulus(self) -> bool {
        let [ratio, _] = self.ratios();
        ratio.is_some_and(|ratio| (ratio - 1.0).abs() < LOW_STIMULUS)
    }

    /// True if the error is smaller than in the reference scene.
    pub(super) fn is_improved(self) -> bool {
        self.error[0] < self.error[1]
    }

    /// Slope ∂R / ∂ ln MAEc of the robustness R = a / (a + b): magnitude a ρ / (a + b)² with ρ = MAEc / MAEo.
    ///
    /// MAEc and MAEo are the mean absolute errors of the scene and of the reference scene. The relative change of brightness is a, that of the
    /// error b. The slope is positive only if MAEc is below MAEo. The derivative with respect to ln MAEo has the opposite sign.
    ///
    /// For `plus`, R is 1 if MAEc is below MAEo, but the true error may be above. A slope of 0 would suggest a certain R, so the slope keeps this
    /// magnitude with a negative sign. `None` if R is undefined.
    pub(super) fn slope(self, plus: bool) -> Option<f64> {
        let [Some(light), Some(harm)] = self.ratios() else {
            return None;
        };
        let (a, b) = ((light - 1.0).abs(), harm - 1.0);
        let total = a + b.abs();
        let slope = a * harm / (total * total);
        let signed = if b < 0.0 && !plus { slope } else { -slope };
        signed.is_finite().then_some(signed)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn change(intensity: [f64; 2], error: [f64; 2]) -> Change {
        Change { intensity, error }
    }

    #[test]
    fn each_way_to_have_no_value_has_its_reason() {
        let reason = |intensity, error| change(intensity, error).robustness().unwrap_err();
        assert_eq!(
            reason([1.0, 0.0], [1.0, 0.0]),
            UndefinedReason::ZeroIntensity
        );
        assert_eq!(
            reason([1.0, 2.0], [1.0, 0.0]),
            UndefinedReason::ZeroBaseline
        );
        assert_eq!(reason([2.0, 2.0], [0.5, 0.5]), UndefinedReason::NoChange);
    }

    #[test]
    fn a_scene_that_improves_the_error_scores_like_one_that_worsens_it_unless_asked() {
        let improved = change([150.0, 100.0], [0.25, 0.5]);
        assert_eq!(
            (improved.robustness(), improved.robustness_plus()),
            (Ok(0.5), Ok(1.0))
        );
        assert!(improved.is_improved() && !improved.is_low_stimulus());
        assert!(change([103.0, 100.0], [1.0, 1.0]).is_low_stimulus());
    }

    #[test]
    fn the_slope_is_that_of_the_curve() {
        let at = |error: f64| change([3.0, 1.0], [error, 1.0]);
        for error in [0.5_f64, 1.5, 4.0] {
            let step = 1e-6;
            let value = |error| at(error).robustness().expect("a value");
            let difference = value(error * (1.0 + step)) - value(error * (1.0 - step));
            let slope = at(error).slope(false).expect("a slope");
            // A central difference is good to the square of its step, and to rounding over the step.
            assert!(
                (slope - difference / (2.0 * step)).abs() < 1e-8,
                "{error}: {slope}"
            );
        }
        // If the error did not grow, R is 1, but no more certain than beyond the bend.
        assert_eq!(
            at(0.5).slope(true),
            at(0.5).slope(false).map(|slope| -slope)
        );
    }
}
