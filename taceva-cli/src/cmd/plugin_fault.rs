//! Picture fault made by an estimator of a plugin, which predicts the pixel values of the faulty picture from the original.

use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Arc, mpsc};
use std::time::Duration;

use taceva_core::{
    Channel, Channels, EstimatorFactory, FeatureShape, Features, Frame, ModelError, Saved, Unit,
    shown, suggestion,
};
use taceva_stress::{GEL_FAULTS, PictureFault, select};

/// Greatest accepted time of the estimator for one picture.
const LONGEST: Duration = Duration::from_secs(1);
/// Greatest accepted time of the estimator for the first picture, for which the plugin also starts.
const FIRST: Duration = Duration::from_secs(10);

/// True if `name` is the name of a fault of this program, or of a list of such faults.
pub(super) fn is_taken(name: &str) -> bool {
    GEL_FAULTS.contains(&name.trim()) || select(&[name.to_owned()]).is_ok()
}

/// Estimator with this `key`, or a message that no plugin has this estimator.
pub(super) fn find(
    estimators: &[Arc<dyn EstimatorFactory>],
    key: &str,
) -> Result<Arc<dyn EstimatorFactory>, String> {
    let mut known = estimators.iter();
    let found = known.find(|known| known.key().as_str() == key);
    found.map(Arc::clone).ok_or_else(|| {
        let keys = estimators.iter().map(|known| known.key().as_str());
        let keys: Vec<&str> = keys.collect();
        format!(
            "`{}`: no plugin has this estimator, {}; `taceva plugin list` lists the installed plugins",
            shown(key),
            match keys.is_empty() {
                true => "none is installed".to_owned(),
                false => suggestion(key, &keys),
            }
        )
    })
}

/// Fault of pictures that a plugin makes.
pub(super) struct PluginFault {
    name: String,
    estimator: Arc<dyn EstimatorFactory>,
    seed: u64,
    is_started: AtomicBool,
}

impl PluginFault {
    pub(super) fn new(name: String, estimator: Arc<dyn EstimatorFactory>, seed: u64) -> Self {
        PluginFault {
            name,
            estimator,
            seed,
            is_started: AtomicBool::new(false),
        }
    }
}

impl PictureFault for PluginFault {
    fn name(&self) -> &str {
        &self.name
    }

    fn key(&self) -> &str {
        self.estimator.key().as_str()
    }

    fn apply(&self, frame: &Frame, severity: u8, sample: &str) -> Result<Frame, String> {
        let info = frame.info();
        let (scale, depth) = (info.format.full_scale(), info.format.samples());
        let request = format!(
            "taceva.fault/1\nseverity={severity}\nseed={}\nsample={sample}\nwidth={}\nheight={}\nfull_scale={scale}\nnumbers={depth}\n",
            self.seed, info.width, info.height
        );
        let numbers: Vec<f32> = frame.samples().map(f32::from).collect();
        let estimator = Arc::clone(&self.estimator);
        let (sender, receiver) = mpsc::channel();
        // A plugin that does not answer leaves its thread behind, which ends with the program.
        std::thread::spawn(move || {
            let numbers = predicted(&*estimator, &request, numbers, depth);
            drop(sender.send(numbers));
        });
        let longest = match self.is_started.load(Ordering::Relaxed) {
            true => LONGEST,
            false => FIRST,
        };
        let answer = receiver.recv_timeout(longest);
        let answer = answer.map_err(|_| {
            let seconds = longest.as_secs();
            format!(
                "no picture within {seconds} s: make the fault faster, or test smaller pictures"
            )
        })?;
        self.is_started.store(true, Ordering::Relaxed);
        let numbers = answer.map_err(|error| error.to_string())?;
        let words = numbers.iter().map(|number| rounded(*number, scale));
        let bytes: Vec<u8> = match info.format.bytes_per_sample() {
            1 => words.map(|word| word.to_le_bytes()[0]).collect(),
            _ => words.flat_map(u16::to_le_bytes).collect(),
        };
        Frame::new(info, bytes).map_err(|error| error.to_string())
    }
}

/// Pixel values of the picture with the fault. A sample of the estimator is a pixel, row by row from the top, and each of its values is a channel.
fn predicted(
    estimator: &dyn EstimatorFactory,
    request: &str,
    numbers: Vec<f32>,
    depth: usize,
) -> Result<Vec<f64>, ModelError> {
    let invalid = |error: &dyn std::fmt::Display| {
        ModelError::new(taceva_core::ErrorKind::InvalidArgument, error.to_string())
    };
    let names: &[&str] = match depth {
        1 => &["gray"],
        _ => &["red", "green", "blue"],
    };
    let channels = names.iter().map(|name| Channel::named(name, Unit::One));
    let channels: Result<Vec<Channel>, _> = channels.collect();
    let channels = channels.map_err(|error| invalid(&error))?;
    let channels = Channels::new(channels).map_err(|error| invalid(&error))?;
    let shape = FeatureShape::flat(depth);
    let mut into = vec![0.0; numbers.len()];
    let features = Features::new(shape, numbers)?;
    let fault = estimator.load(&Saved::new(request.as_bytes(), &channels, shape))?;
    fault.predict(&features, &mut into)?;
    Ok(into)
}

/// Pixel value: rounded half to even and clamped to 0 to `scale`.
fn rounded(number: f64, scale: u16) -> u16 {
    let number = number.round_ties_even().clamp(0.0, f64::from(scale));
    #[expect(
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        reason = "the number is clamped to a range of whole numbers"
    )]
    let number = number as u16;
    number
}

#[cfg(test)]
mod tests {
    use taceva_core::{
        DriverKey, ErrorKind, FitRequest, FrameInfo, PixelFormat, Regressor, SavedRegressor,
    };

    use super::*;

    /// Reply of the test estimator to a picture.
    #[derive(Clone, Copy)]
    enum Answer {
        Darker,
        NotANumber,
        TooLate,
    }

    struct Drawn {
        key: DriverKey,
        answer: Answer,
    }

    struct Loaded {
        channels: Channels,
        shape: FeatureShape,
        severity: f64,
        answer: Answer,
    }

    impl EstimatorFactory for Drawn {
        fn key(&self) -> &DriverKey {
            &self.key
        }
        fn title(&self) -> &str {
            "drawn"
        }
        fn fit(&self, _: &FitRequest<'_>) -> Result<Box<dyn SavedRegressor>, ModelError> {
            Err(ModelError::new(
                ErrorKind::Unsupported,
                "a fault is not fitted",
            ))
        }
        fn load(&self, saved: &Saved<'_>) -> Result<Box<dyn SavedRegressor>, ModelError> {
            let text = String::from_utf8_lossy(saved.bytes).into_owned();
            assert!(text.starts_with("taceva.fault/1\n"), "{text}");
            let severity = text.lines().find_map(|line| line.strip_prefix("severity="));
            Ok(Box::new(Loaded {
                channels: saved.channels.clone(),
                shape: saved.shape,
                severity: severity.and_then(|text| text.parse().ok()).expect("stated"),
                answer: self.answer,
            }))
        }
    }

    impl Regressor for Loaded {
        fn channels(&self) -> &Channels {
            &self.channels
        }
        fn shape(&self) -> FeatureShape {
            self.shape
        }
        fn predict(&self, features: &Features, into: &mut [f64]) -> Result<(), ModelError> {
            match self.answer {
                Answer::Darker => {
                    for (to, from) in into.iter_mut().zip(features.values()) {
                        *to = f64::from(*from) - 10.0 * self.severity;
                    }
                    Ok(())
                }
                Answer::NotANumber => {
                    Err(ModelError::new(ErrorKind::DeviceFault, "NaN at sample 0"))
                }
                Answer::TooLate => {
                    std::thread::sleep(Duration::from_millis(1500));
                    Ok(())
                }
            }
        }
    }

    impl SavedRegressor for Loaded {
        fn save(&self) -> Result<Vec<u8>, ModelError> {
            Ok(Vec::new())
        }
    }

    fn fault(answer: Answer) -> PluginFault {
        let drawn = Drawn {
            key: "org.example/drawn".parse().expect("a key"),
            answer,
        };
        PluginFault::new("drawn".to_owned(), Arc::new(drawn), 1)
    }

    fn frame() -> Frame {
        let info = FrameInfo {
            width: 2,
            height: 1,
            format: PixelFormat::Rgb8,
        };
        Frame::new(info, vec![5, 50, 100, 150, 200, 255]).expect("six numbers")
    }

    #[test]
    fn a_picture_goes_in_and_a_picture_of_whole_numbers_comes_out() {
        let found = fault(Answer::Darker).apply(&frame(), 2, "press-1/0");
        let found = found.expect("a picture");
        assert_eq!(found.bytes(), [0, 30, 80, 130, 180, 235]);
        assert_eq!(found.info(), frame().info());
    }

    #[test]
    fn an_error_of_the_plugin_is_the_reason() {
        let reason = fault(Answer::NotANumber).apply(&frame(), 1, "0");
        assert!(
            reason
                .expect_err("not a number")
                .contains("NaN at sample 0")
        );
    }

    #[test]
    fn a_picture_after_more_than_a_second_is_no_answer() {
        let late = fault(Answer::TooLate);
        late.is_started.store(true, Ordering::Relaxed);
        let reason = late.apply(&frame(), 1, "0").expect_err("too late");
        assert!(reason.contains("no picture within 1 s"), "{reason}");
    }
}
