//! Source of features: frames or signals of a recording.

use taceva_core::{FrameInfo, SignalInfo};

use super::error::FeatureError;
use super::kinds::FeatureKinds;
use super::spec::{COLOR, FeatureSpec, INPUT, KINDS, SIZE};
use crate::settings::ModelSettings;

impl FeatureSpec {
    /// Adapts these features to a recording. Uses signals if they are requested or the recording has no frames. `settings` are the settings that
    /// [`changed_by`](FeatureSpec::changed_by) already applied.
    ///
    /// ```
    /// use taceva_core::{SignalInfo, Unit};
    /// use taceva_models::{FeatureError, FeatureSpec, ModelSettings};
    /// let taxels = SignalInfo::new(5, 1, 3, Unit::Microtesla)?;
    /// let settings = ModelSettings::default();
    /// let spec = FeatureSpec::DEFAULT.on(&settings, None, Some(taxels))?;
    /// assert_eq!(spec.to_string(), "signals of 5×1 places of 3");
    /// let color = ModelSettings::parse(["color=rgb"])?;
    /// assert!(matches!(spec.on(&color, None, Some(taxels)), Err(FeatureError::NoFrames { .. })));
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    ///
    /// # Errors
    /// [`FeatureError::TwoInputs`] if a recording has both inputs and no setting selects an input. [`FeatureError::NoFrames`] or
    /// [`FeatureError::NoSignals`] if the requested input is missing.
    pub fn on(
        self,
        settings: &ModelSettings,
        frame: Option<FrameInfo>,
        signals: Option<SignalInfo>,
    ) -> Result<FeatureSpec, FeatureError> {
        let asked = settings.get(INPUT.key);
        let wants_signals = asked == Some("signals") || self.kinds == FeatureKinds::SIGNALS;
        let word = |key: &str| settings.get(key).map(|value| format!("{key}={value}"));
        match (wants_signals, frame, signals) {
            (true, _, None) => Err(FeatureError::NoSignals),
            (false, Some(_), Some(_)) if asked.is_none() => Err(FeatureError::TwoInputs),
            (false, _, None) | (false, Some(_), Some(_)) => Ok(self),
            (true, _, Some(info)) | (false, None, Some(info)) => {
                let of_signals = settings.get(KINDS.key) == Some("signals");
                let kinds = word(KINDS.key).filter(|_| !of_signals);
                let input = word(INPUT.key).filter(|_| asked != Some("signals"));
                let of_frames = input.or(kinds).or(word(SIZE.key)).or(word(COLOR.key));
                match of_frames {
                    None => Ok(self.of_signals(info)),
                    Some(asked) => Err(FeatureError::NoFrames {
                        asked,
                        has: match frame {
                            None => "only signals",
                            Some(_) => "signals, which were requested",
                        },
                    }),
                }
            }
        }
    }
}
