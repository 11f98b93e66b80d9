//! Fault with a fixed parameter, applied to pictures or signals.

use taceva_core::random::{Draws, fnv_1a, mix};
use taceva_core::{Frame, Signals, single};
use taceva_dataset::Leds;
use taceva_models::MarkerTracker;

use crate::canvas::{Canvas, Realisation};
use crate::fault::{Effect, Fault, Markers, Scope};
use crate::taxels::TaxelDraw;

/// Seeds of the random draws of `fault`: `count` seeds for a fault with random positions, otherwise one seed. The first is `seed`.
pub(crate) fn draw_seeds(fault: &Fault, seed: u64, count: u32) -> Vec<u64> {
    let others = match fault.scope {
        Scope::Drawn => 1..count,
        Scope::Fixed | Scope::Each => 1..1,
    };
    let others = others.map(|draw| mix(mix(seed) ^ u64::from(draw)));
    [seed].into_iter().chain(others).collect()
}

/// Fault with a fixed parameter and its random numbers.
///
/// A picture with the fault depends only on the picture, the fault, its parameter, the seed and the name of the sample. The order of the pictures
/// and the number of threads change no bit.
///
/// ```
/// use taceva_core::{Frame, FrameInfo, PixelFormat};
/// use taceva_stress::{FAULTS, Stress};
/// let info = FrameInfo { width: 2, height: 1, format: PixelFormat::Gray8 };
/// let frame = Frame::new(info, vec![100, 200])?;
/// let darker = FAULTS.into_iter().find(|fault| fault.id == "exposure_low").expect("in the list");
/// let dark = Stress::new(darker, 0.5, 1).apply(&frame, "press-7", None);
/// assert_eq!(dark.bytes(), [50, 100]);
/// assert_eq!(Stress::new(darker, 0.0, 1).apply(&frame, "press-7", None), frame);
/// # Ok::<(), taceva_core::FrameError>(())
/// ```
#[derive(Clone, Copy, Debug)]
pub struct Stress<'m> {
    fault: &'static Fault,
    parameter: f64,
    seed: u64,
    markers: Option<&'m MarkerTracker>,
    leds: Leds,
}

impl<'m> Stress<'m> {
    /// Creates `fault` with this parameter. If `parameter` is not above 0, the fault changes nothing.
    pub fn new(fault: &'static Fault, parameter: f64, seed: u64) -> Stress<'m> {
        Stress {
            fault,
            parameter,
            seed,
            markers: None,
            leds: Leds::default(),
        }
    }

    /// Sets the markers of the untouched picture. Without markers, a fault of markers changes no picture.
    #[must_use]
    pub fn with_markers(self, markers: Option<&'m MarkerTracker>) -> Stress<'m> {
        Stress { markers, ..self }
    }

    /// Sets the LEDs of the sensor. A loss of LEDs then dims only the colours of one side, unless the picture is gray.
    #[must_use]
    pub fn with_leds(self, leds: Leds) -> Stress<'m> {
        Stress { leds, ..self }
    }

    /// Sets the time, as a fraction of the duration of the recording, from 0 to 1. Only a fault that grows with time depends on it.
    #[must_use]
    pub fn at(self, share: f64) -> Stress<'m> {
        match self.fault.grows() {
            true => Stress {
                parameter: self.parameter * share,
                ..self
            },
            false => self,
        }
    }

    /// Kind of the fault.
    pub fn fault(&self) -> &'static Fault {
        self.fault
    }

    /// Parameter of the fault, in the unit that the fault states.
    pub fn parameter(&self) -> f64 {
        self.parameter
    }

    /// True if the fault repeats pictures, so that it needs the previous picture.
    pub fn repeats(&self) -> bool {
        matches!(self.fault.effect, Effect::Before)
    }

    /// Returns the picture `frame` of `sample` with the fault. `before` is the previous picture, if any.
    pub fn apply(&self, frame: &Frame, sample: &str, before: Option<&Frame>) -> Frame {
        if self.parameter <= 0.0 || frame.bytes().is_empty() {
            return frame.clone();
        }
        match self.fault.effect {
            Effect::Numbers(change) | Effect::Growing(change) => {
                let mut canvas = Canvas::of(frame);
                change(&mut canvas, &self.drawn(sample));
                canvas.into_frame()
            }
            Effect::Leds(change) => {
                let mut canvas = Canvas::of(frame);
                let leds = Some(self.leds).filter(|_| canvas.colours() > 1);
                change(&mut canvas, &self.drawn(sample), leds.unwrap_or_default());
                canvas.into_frame()
            }
            Effect::Markers(change) => match self.markers_of(frame) {
                Some(markers) => {
                    let mut canvas = Canvas::of(frame);
                    change(&mut canvas, &self.drawn(sample), &markers);
                    canvas.into_frame()
                }
                None => frame.clone(),
            },
            Effect::Labels(_) | Effect::Taxels(_) | Effect::Rows => frame.clone(),
            Effect::Before => match before.filter(|_| self.is_repeated(sample)) {
                Some(before) => before.clone(),
                None => frame.clone(),
            },
        }
    }

    /// Returns `signals` with the fault, `hours` after the first sample. `full_scale` has the greatest change by contact of each number of a taxel.
    /// A fault of another kind changes no signals.
    pub fn apply_to_signals(&self, signals: &Signals, full_scale: &[f64], hours: f64) -> Signals {
        let change = match self.fault.effect {
            Effect::Taxels(of) if self.parameter > 0.0 => of.change,
            _ => return signals.clone(),
        };
        let mut values = signals.values().to_vec();
        let drawn = TaxelDraw {
            parameter: self.parameter,
            channels: signals.info().channels as usize,
            full_scale,
            hours,
            draws: self.of_fault(),
        };
        change(&mut values, &drawn);
        Signals::new(signals.info(), values).expect("as many numbers as before, all finite")
    }

    /// True if the fault removes the row of `sample` from the recording.
    pub fn leaves_out(&self, sample: &str) -> bool {
        self.fault.is_of_rows() && self.draws(sample).unit(0) < self.parameter
    }

    /// True if the previous picture replaces the picture of `sample`.
    pub(crate) fn is_repeated(&self, sample: &str) -> bool {
        self.repeats() && self.draws(sample).unit(0) < self.parameter
    }

    /// Parameter and random numbers of the fault in the picture of `sample`.
    fn drawn(&self, sample: &str) -> Realisation {
        Realisation {
            parameter: single(self.parameter),
            draws: self.draws(sample),
        }
    }

    /// Positions in `frame` of the markers of the untouched picture; `None` if none is found.
    fn markers_of(&self, frame: &Frame) -> Option<Markers> {
        let tracker = self.markers?;
        let tracked = tracker.track(frame).ok()?;
        let places = tracker.markers().iter().zip(&tracked);
        let places = places.map(|(marker, tracked)| {
            let [x, y] = marker.place_px;
            let [right, down] = tracked.displacement_px;
            [x + right, y + down]
        });
        Some(Markers {
            places_px: places.collect(),
            spacing_px: tracker.spacing_px(),
        })
    }

    /// Random numbers of the fault in the picture of `sample`.
    fn draws(&self, sample: &str) -> Draws {
        match self.fault.scope {
            Scope::Fixed | Scope::Drawn => self.of_fault(),
            Scope::Each => self.of_fault().of(fnv_1a(sample.as_bytes())),
        }
    }

    /// Random numbers of the fault, which depend on no sample.
    pub(crate) fn of_fault(&self) -> Draws {
        Draws::new(mix(mix(self.seed) ^ fnv_1a(self.fault.id.as_bytes())))
    }
}
