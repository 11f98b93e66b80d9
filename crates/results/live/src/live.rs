//! State that the devices' program shares with the page: the newest values, without history.

use std::sync::atomic::{AtomicBool, AtomicU64, AtomicUsize, Ordering};
use std::sync::{Arc, Condvar, Mutex, MutexGuard, OnceLock, PoisonError};
use std::time::{Duration, Instant};

use taceva_core::{Frame, Pose, Wrench};
use taceva_protocol::{Answer, Question};

use crate::frames::Frames;
use crate::overlay::Overlay;
use crate::state::{Asked, Limits, Place, PlaceState, PredictedFrames, State};

/// Content of a page, written by the program that controls the devices. Clones share one state. No call waits for a browser.
#[derive(Clone)]
pub struct Live {
    pub(crate) shared: Arc<Shared>,
}

pub(crate) struct Shared {
    state: Mutex<Inside>,
    answered: Condvar,
    pub(crate) frames: Frames,
    /// Number of open streams. Frames are encoded only while a stream is open.
    pub(crate) viewers: AtomicUsize,
    pub(crate) is_over: AtomicBool,
    /// Number of the last picture with a prediction that was sent to a browser.
    last_sent: AtomicU64,
    /// Callback for each sent picture with a prediction. The argument is the stamp of the frame, s.
    on_sent: OnceLock<Box<dyn Fn(f64) + Send + Sync>>,
}

#[derive(Default)]
struct Inside {
    state: State,
    places: Vec<Place>,
    /// Version of the list of press places, incremented at each change.
    places_version: u64,
    questions: u64,
    /// Arrival times of recent frames, for their rate.
    recent: std::collections::VecDeque<Instant>,
}

/// Time over which the frame rate is averaged.
const RATE_OVER: Duration = Duration::from_secs(2);

impl Live {
    /// Creates an empty page with the heading `title`.
    pub fn new(title: &str) -> Live {
        let state = State {
            title: title.to_owned(),
            ..State::default()
        };
        let inside = Inside {
            state,
            ..Inside::default()
        };
        Live {
            shared: Arc::new(Shared {
                state: Mutex::new(inside),
                answered: Condvar::new(),
                frames: Frames::default(),
                viewers: AtomicUsize::new(0),
                is_over: AtomicBool::new(false),
                last_sent: AtomicU64::new(0),
                on_sent: OnceLock::new(),
            }),
        }
    }

    /// Shows `frame` as the newest frame. Frames beyond the picture rate are counted but not shown.
    pub fn frame(&self, frame: &Frame) {
        self.count_frame();
        // Also without viewers: a later viewer sees the last frame, which may be the only one for a while.
        self.shared.frames.offer(frame, None);
    }

    /// Shows `frame` as the newest frame, with the predictions of a model over the picture.
    pub fn predicted(&self, frame: &Frame, overlay: Overlay) {
        self.count_frame();
        self.shared.frames.offer(frame, Some(overlay));
    }

    /// Shows `words`, the name of the model that makes the predictions.
    pub fn predictor(&self, words: &str) {
        self.shared.inside().state.predicted_by = Some(words.to_owned());
    }

    /// Shows the numbers of predicted and dropped frames.
    pub fn predicted_frames(&self, frames: PredictedFrames) {
        self.shared.inside().state.predicted = Some(frames);
    }

    /// Sets the callback `heard`, which is called for each picture with a prediction that is sent to a browser. The argument is the stamp of the
    /// frame, s.
    ///
    /// The callback runs on a thread of the page. Later callbacks are ignored.
    pub fn on_sent(&self, heard: impl Fn(f64) + Send + Sync + 'static) {
        drop(self.shared.on_sent.set(Box::new(heard)));
    }

    fn count_frame(&self) {
        let now = Instant::now();
        let mut inside = self.shared.inside();
        inside.state.frames += 1;
        inside.recent.push_back(now);
        while inside
            .recent
            .front()
            .is_some_and(|first| now.duration_since(*first) > RATE_OVER)
        {
            inside.recent.pop_front();
        }
    }

    /// Shows a reading of the tared force transducer.
    pub fn force(&self, wrench: &Wrench) {
        let [x, y, z] = wrench.force.map(|force| force.0);
        let mut inside = self.shared.inside();
        (inside.state.normal_n, inside.state.shear_n) = (Some(z), Some(x.hypot(y)));
    }

    /// Shows the depth of the tip at `pose`. The pose is in the frame of the sensor.
    pub fn pose(&self, pose: &Pose) {
        self.shared.inside().state.depth_mm = Some(pose.position.z.0);
    }

    /// Shows the limits of force and depth.
    pub fn limits(&self, limits: Limits) {
        self.shared.inside().state.limits = limits;
    }

    /// Shows `words` as the current stage.
    pub fn stage(&self, words: &str) {
        words.clone_into(&mut self.shared.inside().state.stage);
    }

    /// Shows the numbers of dropped and of damaged frames. The count of dropped frames is complete only if the camera numbers its frames (`numbered`).
    pub fn lost(&self, dropped: u64, damaged: u64, numbered: bool) {
        let mut inside = self.shared.inside();
        let state = &mut inside.state;
        (state.dropped, state.damaged, state.numbered) = (dropped, damaged, numbered);
    }

    /// Shows the planned places of presses on the gel.
    pub fn places(&self, places: Vec<Place>) {
        let mut inside = self.shared.inside();
        inside.state.presses = [done(&places), places.len()];
        inside.places = places;
        inside.places_version += 1;
    }

    /// Changes the state of the press at place `number`, counted from 0.
    pub fn place(&self, number: usize, state: PlaceState) {
        let mut inside = self.shared.inside();
        let Some(place) = inside.places.get_mut(number) else {
            return;
        };
        place.state = state;
        inside.state.presses[0] = done(&inside.places);
        inside.places_version += 1;
    }

    /// Ends the page and shows `words` as the result of the run.
    pub fn ended(&self, words: &str) {
        self.shared.inside().state.ended = Some(words.to_owned());
    }

    /// True if a user has pressed the stop button.
    pub fn is_stopping(&self) -> bool {
        self.shared.inside().state.is_stopping
    }

    /// Shows `question` with its buttons until the returned value is dropped.
    pub fn ask(&self, question: &Question) -> Open {
        let mut inside = self.shared.inside();
        inside.questions += 1;
        let number = inside.questions;
        inside.state.question = Some(Asked::new(number, question));
        drop(inside);
        Open {
            live: self.clone(),
            number,
        }
    }
}

fn done(places: &[Place]) -> usize {
    let is_done = |place: &&Place| matches!(place.state, PlaceState::Done | PlaceState::Short);
    places.iter().filter(is_done).count()
}

/// Open question on the page. Dropping the value removes the question.
pub struct Open {
    live: Live,
    number: u64,
}

impl Open {
    /// Waits for the answer for at most `patience`; `None` if there is no answer.
    pub fn answer(&self, patience: Duration) -> Option<Answer> {
        let shared = &self.live.shared;
        let is_open = |inside: &mut Inside| match &inside.state.question {
            Some(asked) => asked.number == self.number && asked.answer.is_none(),
            None => false,
        };
        let waited = shared
            .answered
            .wait_timeout_while(shared.inside(), patience, is_open);
        let (inside, _) = waited.unwrap_or_else(PoisonError::into_inner);
        let asked = inside.state.question.as_ref();
        asked
            .filter(|asked| asked.number == self.number)
            .and_then(|asked| asked.answer)
    }
}

impl Drop for Open {
    fn drop(&mut self) {
        let mut inside = self.live.shared.inside();
        let question = &mut inside.state.question;
        question.take_if(|asked| asked.number == self.number);
    }
}

impl Shared {
    /// Records the answer to question `number`. False if the question is not open.
    pub(crate) fn give_answer(&self, number: u64, answer: Answer) -> bool {
        let mut inside = self.inside();
        let asked = inside.state.question.as_mut();
        let Some(asked) = asked.filter(|asked| asked.number == number && asked.answer.is_none())
        else {
            return false;
        };
        asked.answer = Some(answer);
        drop(inside);
        self.answered.notify_all();
        true
    }

    /// Records that picture `number` was sent to a browser.
    pub(crate) fn sent(&self, number: u64, overlay: &Overlay) {
        let before = self.last_sent.fetch_max(number, Ordering::AcqRel);
        if let Some(heard) = self.on_sent.get().filter(|_| before < number) {
            heard(overlay.stamp_s);
        }
    }

    /// Records that a user pressed the stop button.
    pub(crate) fn stop(&self) {
        self.inside().state.is_stopping = true;
    }

    /// State of the page as JSON, without the press places.
    pub(crate) fn state_json(&self) -> String {
        let mut inside = self.inside();
        let sight = self.frames.sight();
        let over = inside
            .recent
            .front()
            .zip(inside.recent.back())
            .map(|(first, last)| last.duration_since(*first).as_secs_f64());
        let count = u32::try_from(inside.recent.len()).unwrap_or(u32::MAX);
        let state = &mut inside.state;
        state.rate_hz = match over {
            Some(over_s) if over_s > 0.0 => f64::from(count - 1) / over_s,
            _ => 0.0,
        };
        state.saturated = sight.map(|sight| sight.saturated);
        state.sharpness = sight.map(|sight| sight.sharpness);
        serde_json::to_string(state).unwrap_or_default()
    }

    /// Press places as JSON; `None` if unchanged since `version`. Updates `version`.
    pub(crate) fn places_json(&self, version: &mut Option<u64>) -> Option<String> {
        let inside = self.inside();
        if *version == Some(inside.places_version) {
            return None;
        }
        *version = Some(inside.places_version);
        serde_json::to_string(&inside.places).ok()
    }

    fn inside(&self) -> MutexGuard<'_, Inside> {
        self.state.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_answer_reaches_its_own_question_and_no_later_one() {
        let live = Live::new("test");
        let first = live.ask(&Question::Unit("a".to_owned()));
        assert!(!live.shared.give_answer(2, Answer::Done), "not asked yet");
        assert!(live.shared.give_answer(1, Answer::Skip));
        assert!(
            !live.shared.give_answer(1, Answer::Done),
            "answered already"
        );
        assert_eq!(first.answer(Duration::ZERO), Some(Answer::Skip));
        drop(first);
        let second = live.ask(&Question::Unit("b".to_owned()));
        assert!(!live.shared.give_answer(1, Answer::Done), "a late press");
        assert_eq!(second.answer(Duration::ZERO), None);
        drop(second);
        assert!(live.shared.state_json().contains("\"question\":null"));
    }

    #[test]
    fn presses_are_counted_as_their_places_change() {
        let live = Live::new("test");
        let place = Place {
            x_mm: 1.0,
            y_mm: -2.0,
            state: PlaceState::Open,
        };
        live.places(vec![place; 3]);
        let mut version = None;
        assert!(live.shared.places_json(&mut version).is_some());
        assert_eq!(live.shared.places_json(&mut version), None);
        live.place(1, PlaceState::Short);
        live.place(2, PlaceState::Now);
        live.place(9, PlaceState::Done);
        let places = live.shared.places_json(&mut version).expect("changed");
        assert!(places.contains("\"short\""), "{places}");
        let state = live.shared.state_json();
        assert!(state.contains("\"presses\":[1,3]"), "{state}");
    }
}
