//! Page that shows devices.

use std::collections::HashMap;
use std::sync::atomic::{AtomicU64, Ordering};
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};

use taceva_acquire::Viewer;
use taceva_core::{Frame, Nanometre, Pose, PressOutcome, Wrench};
use taceva_dataset::StreamFacts;
use taceva_live::{Limits, Live, Page, Place, PlaceState};
use taceva_protocol::{ContentId, Event, Plan};

use crate::progress;

/// Open page, with the state that it shows.
pub(crate) struct OnPage {
    page: Page,
    shown: Arc<Shown>,
}

impl OnPage {
    /// Opens a page called `title`. Its stop button acts like a signal to the program.
    pub(crate) fn open(title: &str, port: u16) -> anyhow::Result<OnPage> {
        let live = Live::new(title);
        let page = Page::open(&live, port, progress::stop)?;
        Ok(OnPage {
            page,
            shown: Arc::new(Shown {
                live,
                presses: Mutex::default(),
                retried: AtomicU64::new(0),
            }),
        })
    }

    /// Address for a browser.
    pub(crate) fn url(&self) -> String {
        self.page.url()
    }

    /// State that the page shows.
    pub(crate) fn live(&self) -> Live {
        self.shown.live.clone()
    }

    /// Viewer that shows the devices on the page.
    pub(crate) fn viewer(&self) -> Arc<dyn Viewer> {
        Arc::clone(&self.shown) as Arc<dyn Viewer>
    }
}

/// Viewer that writes data of devices to the page.
struct Shown {
    live: Live,
    presses: Mutex<Presses>,
    /// Number of frames that were captured again during a run.
    retried: AtomicU64,
}

/// Index of each press among the places on the page.
#[derive(Default)]
struct Presses {
    numbers: HashMap<ContentId, usize>,
}

impl Shown {
    fn presses(&self) -> MutexGuard<'_, Presses> {
        self.presses.lock().unwrap_or_else(PoisonError::into_inner)
    }

    fn set(&self, press: ContentId, state: PlaceState) {
        if let Some(number) = self.presses().numbers.get(&press) {
            self.live.place(*number, state);
        }
    }
}

impl Viewer for Shown {
    fn begins(&self, plan: &Plan, unit: &str, is_recorded: &dyn Fn(ContentId) -> bool) {
        let of_unit: Vec<_> = (plan.presses.iter())
            .filter(|press| press.press.unit == unit)
            .collect();
        let mm = |length: Nanometre| length.to_millimetres();
        let places = of_unit.iter().map(|press| Place {
            x_mm: mm(press.press.place[0]),
            y_mm: mm(press.press.place[1]),
            state: match is_recorded(press.id) {
                true => PlaceState::Done,
                false => PlaceState::Open,
            },
        });
        self.live.places(places.collect());
        let numbers = of_unit.iter().map(|press| press.id).zip(0..);
        self.presses().numbers = numbers.collect();
        if let Some(limits) = &plan.limits {
            self.live.limits(
                Limits::none()
                    .with_forces(limits.normal_max.0, limits.shear_max.0)
                    .with_depth(limits.depth_max.0),
            );
        }
        self.live
            .stage(&format!("{}, unit {unit}: approaching", plan.name));
    }

    fn event(&self, event: &Event) {
        let live = &self.live;
        match event {
            Event::Approaching { press, number } => {
                live.stage(&format!("press {number}"));
                self.set(*press, PlaceState::Now);
            }
            Event::Finished { press, outcome } => self.set(
                *press,
                match outcome {
                    PressOutcome::Complete => PlaceState::Done,
                    _ => PlaceState::Short,
                },
            ),
            Event::Skipped(press) => self.set(*press, PlaceState::Skipped),
            Event::FrameRetried => {
                let retried = 1 + self.retried.fetch_add(1, Ordering::AcqRel);
                live.lost(retried, 0, true);
            }
            Event::FrameFrozen => {
                live.stage("the camera repeats a frame: press cancelled");
            }
            Event::ZeroStepped(_) => {
                live.stage("the zero of the force changed: press cancelled");
            }
            Event::Halted(trip) => live.stage(&format!("halted: {trip}")),
            Event::ForceLost(words) => live.stage(words),
            Event::Unheld => live.stage("hold the enabling switch; nothing moves until you do"),
            Event::Mounted(specimen) => live.stage(&format!("mounted: {specimen}")),
            Event::Lit(light) => live.stage(&format!("light {light}")),
            _ => {}
        }
    }

    fn frame(&self, frame: &Frame) {
        self.live.frame(frame);
    }

    fn force(&self, wrench: &Wrench) {
        self.live.force(wrench);
    }

    fn pose(&self, pose: &Pose) {
        self.live.pose(pose);
    }

    fn lost(&self, stream: StreamFacts) {
        self.live
            .lost(stream.dropped, stream.damaged, stream.numbered);
    }
}
