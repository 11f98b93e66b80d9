//! Records taps of the tip on the gel, with the devices of a rig file. Threads record every device while the tip moves, and guard threads watch.

use std::collections::BTreeMap;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};
use std::time::Duration;

use taceva_core::{
    Axes, Deadline, DriverError, ErrorKind, ForceTransducer, Frame, FrameMut, Interrupt,
    RobotWatch, Sensor, Stamp, Tare, Wrench,
};
use taceva_protocol::{
    Cancel, Controls, RunError, SessionSpec, StopCause, TapHeard, TapListener, Tapped, tap,
};

use super::clock_follower::measured_settings;
use super::devices::{OpenRig, Sitting, to_be_enabled};
use super::guardian::{Guarded, Over};
use super::workshop::Workshop;
use crate::error::AcquireError;
use crate::scene::{PlannedStudy, StudySource};

const START: Deadline = Deadline::after(Duration::from_secs(2));
/// Deadline for each pose. A call that misses it is retried.
const POSE: Deadline = Deadline::after(Duration::from_millis(50));
const FRAME: Deadline = Deadline::after(Duration::from_millis(200));
/// Delay before a failing device is retried.
const FAILED_REST: Duration = Duration::from_millis(5);

/// Recorded taps of a rig.
pub(crate) struct TappedRig {
    pub(crate) tapped: Tapped,
    /// True if the robot reports an emulation.
    pub(crate) is_emulated: bool,
    /// Settings of the sensor that were measured during the taps.
    pub(crate) measured: BTreeMap<String, String>,
}

/// Taps the gel on the rig of `study`, and returns the recorded taps. The presses of the study are not made.
///
/// # Errors
/// [`AcquireError::Open`] and [`AcquireError::Acquisition`] if a device fails, the rig contradicts its file, or the run is cancelled.
pub(crate) fn tap_study(
    study: &PlannedStudy,
    workshop: Workshop<'_>,
) -> Result<TappedRig, AcquireError> {
    let mut plan = study.plan.clone();
    for press in &mut plan.presses {
        // The listener thread owns the sensor.
        press.frames = false;
    }
    let failed = |source: RunError| super::operator::stopped(&plan, source);
    let missing = |what: &str| {
        failed(RunError {
            press: None,
            cause: StopCause::Missing(what.to_owned()),
            left: taceva_protocol::Left::Untouched,
        })
    };
    let StudySource::Rig(rig) = &study.source else {
        return Err(missing("a rig"));
    };
    let unit = plan.units.first().map_or("1", String::as_str);
    let cancel = Cancel::new();
    let sitting = Sitting::new(workshop, &cancel);
    let mut open = OpenRig::open(study, rig, unit, sitting)?;
    open.tap(&plan, sitting, missing, failed)
}

impl OpenRig {
    fn tap(
        &mut self,
        plan: &taceva_protocol::Plan,
        sitting: Sitting<'_>,
        missing: impl Fn(&str) -> AcquireError,
        failed: impl Fn(RunError) -> AcquireError,
    ) -> Result<TappedRig, AcquireError> {
        let is_emulated = self.robot.is_emulated();
        let Sitting {
            workshop, cancel, ..
        } = sitting;
        let limits = plan.limits.clone();
        let limits = limits.ok_or_else(|| missing("limits before anything moves"))?;
        let rig_file = self.rig_file.clone();
        let rig_file = rig_file.ok_or_else(|| missing("a rig file"))?;
        let watch = self.robot.watch_handle();
        let watch = watch.ok_or_else(|| {
            missing("a robot that reports its pose while it moves, which this driver does not")
        })?;
        let mut sensor = self.sensor.take();
        let sensor = sensor.as_mut().ok_or_else(|| missing("a sensor"))?;
        sensor.start(START)?;
        let operator = workshop.operator;
        let mut operator =
            operator.map(|operator| operator.lock().unwrap_or_else(PoisonError::into_inner));
        let ears = Ears::default();
        let mut force = Overheard {
            force: &mut *self.force,
            ears: ears.clone(),
        };
        let guarded = Guarded {
            robot: &mut *self.robot,
            force: &mut force,
            driver: self.force_driver.clone(),
            limits,
            switch: self.switch.as_deref(),
            cancel,
            progress: workshop.progress,
            viewer: None,
        };
        let clock = &mut *self.surroundings.clock;
        let session = SessionSpec {
            rig: &rig_file,
            robot: to_be_enabled(&rig_file, false),
            touched: &[],
        };
        let taps = u64::from(Tapped::TAPS);
        workshop
            .progress
            .begin("touch the gel, then tap it", Some(taps));
        let is_over = AtomicBool::new(false);
        let (tapped, heard) = std::thread::scope(|scope| {
            let poses = scope.spawn(|| hear_poses(&*watch, &ears, &is_over));
            let frames = scope.spawn(|| hear_frames(&mut **sensor, &ears, &is_over));
            let tapped = {
                let _over = Over::new(&is_over);
                let (tapped, _) = guarded.conduct(|robot, force, supervisor| {
                    let controls = Controls {
                        clock,
                        cancel,
                        events: &mut |_| {},
                        operator: match &mut operator {
                            Some(operator) => Some(&mut **operator),
                            None => None,
                        },
                    };
                    let mut listener = Listener {
                        ears: ears.clone(),
                        progress: workshop.progress,
                    };
                    tap(
                        plan,
                        robot,
                        force,
                        controls,
                        supervisor,
                        session,
                        &mut listener,
                    )
                });
                tapped
            };
            let ended = [poses.join(), frames.join()];
            let ended = ended.map(|ended| ended.expect("a thread that listens does not panic"));
            (tapped, ended.into_iter().collect::<Result<(), _>>())
        });
        workshop.progress.end();
        // A failed device ends the taps with missing values. Its own error is the cause, so it is returned first.
        heard?;
        sensor.stop()?;
        Ok(TappedRig {
            tapped: tapped.map_err(failed)?,
            is_emulated,
            measured: measured_settings(sensor.settings()),
        })
    }
}

/// Shared recording of the tap in progress; `None` between taps.
#[derive(Clone, Default)]
struct Ears(Arc<Mutex<Option<TapHeard>>>);

impl Ears {
    fn lock(&self) -> MutexGuard<'_, Option<TapHeard>> {
        self.0.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// Lets `say` add a value to the tap in progress; does nothing between taps.
    fn hear(&self, say: impl FnOnce(&mut TapHeard)) {
        if let Some(heard) = &mut *self.lock() {
            say(heard);
        }
    }
}

/// Starts and ends each entry in the shared recording of taps.
struct Listener<'a> {
    ears: Ears,
    progress: &'a dyn taceva_core::Progress,
}

impl TapListener for Listener<'_> {
    fn begins(&mut self) {
        *self.ears.lock() = Some(TapHeard::default());
    }

    fn ends(&mut self) -> TapHeard {
        self.ears.lock().take().unwrap_or_default()
    }

    fn counts(&mut self) {
        self.progress.advance(1);
    }
}

fn hear_poses(
    watch: &dyn RobotWatch,
    ears: &Ears,
    is_over: &AtomicBool,
) -> Result<(), DriverError> {
    while !is_over.load(Ordering::Acquire) {
        match watch.pose(POSE) {
            Ok((pose, stamp)) => ears.hear(|heard| heard.pose(&pose, &stamp)),
            // The guard sees the same error and halts the robot.
            Err(_) => std::thread::sleep(FAILED_REST),
        }
    }
    Ok(())
}

fn hear_frames(
    sensor: &mut dyn Sensor,
    ears: &Ears,
    is_over: &AtomicBool,
) -> Result<(), DriverError> {
    let info = sensor.frame_info();
    let mut bytes = vec![0; info.byte_len().unwrap_or_default()];
    while !is_over.load(Ordering::Acquire) {
        let Ok(into) = FrameMut::new(info, &mut bytes) else {
            // Frames that exceed the memory are missing; the taps report that.
            return Ok(());
        };
        match sensor.capture(into, FRAME) {
            Ok(stamp) => {
                if let Ok(frame) = Frame::new(info, bytes.clone()) {
                    ears.hear(|heard| heard.frame(&frame, &stamp));
                }
            }
            Err(error) if [ErrorKind::Timeout, ErrorKind::Protocol].contains(&error.kind()) => {}
            Err(error) => return Err(error),
        }
    }
    Ok(())
}

/// A transducer whose readings are also added to the tap in progress.
struct Overheard<'a> {
    force: &'a mut dyn ForceTransducer,
    ears: Ears,
}

impl ForceTransducer for Overheard<'_> {
    fn axes(&self) -> Axes {
        self.force.axes()
    }

    fn start(&mut self, deadline: Deadline) -> Result<(), DriverError> {
        self.force.start(deadline)
    }

    fn read(&mut self, deadline: Deadline) -> Result<(Wrench, Stamp), DriverError> {
        let (wrench, stamp) = self.force.read(deadline)?;
        self.ears.hear(|heard| heard.force(&wrench, &stamp));
        Ok((wrench, stamp))
    }

    fn sequence(&self) -> Option<u64> {
        self.force.sequence()
    }

    fn stop(&mut self) -> Result<(), DriverError> {
        self.force.stop()
    }

    fn interrupt_handle(&self) -> Option<Arc<dyn Interrupt>> {
        self.force.interrupt_handle()
    }

    fn tare(&mut self) -> Option<&mut dyn Tare> {
        self.force.tare()
    }
}
