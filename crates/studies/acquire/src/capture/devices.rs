//! Sensor and transducer of a capture or a preview: selected, opened and started.

use std::collections::BTreeMap;
use std::path::Path;
use std::sync::mpsc::sync_channel;
use std::sync::{Mutex, PoisonError};
use std::time::Duration;

use taceva_core::{
    Axis, Certificate, Deadline, Descriptor, DriverError, DriverKey, DriverSource, ErrorKind,
    Facts, Frame, FrameInfo, FrameMut, Instrument, Rig, Sensor, SensorFacts, Traceability, Wrench,
};
use taceva_drivers::{Drivers, OpenError, Selector};
use taceva_protocol::{RigFile, Setting, SignedAxes};

use super::camera::{Camera, ROOM};
use super::device_error;
use super::predictor::LivePredictor;
use super::streams::{Counts, Over, Streams};
use super::track::Track;
use super::transducer::Transducer;
use crate::error::AcquireError;
use crate::instruments::{traced, warnings_today};
use crate::presses::{HeldRigs, Opened, Turned, add_settings, sensor_driver};
use crate::scene::read_rig_file;

/// Deadline for the start of a sensor, and for its first frame.
const FIRST: Duration = Duration::from_secs(5);

/// Devices of a capture or a preview, checked but not opened.
#[derive(Clone, Debug)]
pub struct LiveSpec {
    sensor: Named,
    force: Option<Named>,
    /// Axes of the transducer that correspond to the axes of the sensor. `None` if the rig file names no transducer, or an option names another.
    axes: Option<SignedAxes>,
    is_emulated: bool,
}

/// A device given by its selector.
#[derive(Clone, Debug)]
struct Named {
    selector: Selector,
    /// Latency in ms, if the rig file states it.
    latency_ms: Option<f64>,
    /// Certificate, if the rig file has a certificate.
    certificate: Option<Certificate>,
    /// Origin of the selector, for messages: a command-line option or the rig file.
    by: String,
}

impl LiveSpec {
    /// Reads the devices from selectors, or otherwise from a rig file. The robot in the rig file is not used.
    ///
    /// # Errors
    /// [`AcquireError::Request`] if no sensor is named or a selector is invalid. [`AcquireError::Scene`] for an invalid rig file.
    pub fn new(
        sensor: Option<&str>,
        force: Option<&str>,
        rig: Option<&Path>,
    ) -> Result<LiveSpec, AcquireError> {
        let rig = rig.map(read_rig_file).transpose()?;
        let rig: Option<&RigFile> = rig.as_ref();
        let of_rig = |driver: &str, latency_ms: Option<Setting<f64>>| Wanted {
            text: driver.to_owned(),
            latency_ms: latency_ms.map(|latency| latency.value),
            certificate: None,
            by: rig.map_or_else(String::new, |rig| rig.name().to_owned()),
        };
        let typed = |option: &str, text: &str| Wanted {
            text: text.to_owned(),
            latency_ms: None,
            certificate: None,
            by: option.to_owned(),
        };
        let rig_sensor = rig.and_then(|rig| rig.sensor.as_ref());
        let rig_force = rig.and_then(|rig| rig.force.as_ref());
        let wanted_sensor = sensor
            .map(|text| typed("--sensor", text))
            .or(rig_sensor.map(|sensor| Wanted {
                certificate: sensor.certificate.clone(),
                ..of_rig(&sensor.driver.value, sensor.latency_ms)
            }));
        let wanted_force = force
            .map(|text| typed("--force", text))
            .or(rig_force.map(|force| Wanted {
                certificate: force.certificate.clone(),
                ..of_rig(&force.driver.value, force.latency_ms)
            }));
        let Some(wanted_sensor) = wanted_sensor else {
            let place = rig.map_or_else(String::new, |rig| {
                format!("{} has no [sensor]: ", taceva_core::shown(rig.name()))
            });
            return Err(AcquireError::Request(format!(
                "{place}no sensor is named; expected --sensor DRIVER:ARGUMENTS, as `taceva devices` lists them, or --rig FILE with a [sensor]"
            )));
        };
        Ok(LiveSpec {
            sensor: wanted_sensor.read()?,
            force: wanted_force.map(Wanted::read).transpose()?,
            axes: rig_force
                .filter(|_| force.is_none())
                .map(|force| force.axes.value),
            is_emulated: rig.is_some_and(|rig| rig.simulated),
        })
    }

    /// Selector of the sensor.
    pub fn sensor(&self) -> &Selector {
        &self.sensor.selector
    }

    /// Axes of the transducer in the rig file; `None` for a transducer that an option names, and without a transducer.
    pub fn force_axes(&self) -> Option<SignedAxes> {
        self.axes
    }

    /// Instruments that measure the labels: the transducer, and the sensor if it has a certificate.
    fn traceability(&self) -> Vec<Traceability> {
        let traced_as = |instrument, named: &Named| {
            let selector = named.selector.to_string();
            traced(instrument, &selector, named.certificate.as_ref())
        };
        let force = self.force.as_ref();
        let force = force.map(|force| traced_as(Instrument::Force, force));
        let sensor = Some(&self.sensor).filter(|sensor| sensor.certificate.is_some());
        let sensor = sensor.map(|sensor| traced_as(Instrument::Sensor, sensor));
        force.into_iter().chain(sensor).collect()
    }

    /// Real devices, which only one command at a time can use.
    fn real(&self, drivers: &Drivers) -> BTreeMap<String, String> {
        let sensor = drivers.sensors.get(self.sensor.selector.driver());
        let is_real = |descriptor: &Descriptor| descriptor.source() == DriverSource::Real;
        let mut real = BTreeMap::new();
        let mut take =
            |named: &Named| drop(real.insert(named.selector.to_string(), named.by.clone()));
        if sensor.is_ok_and(|sensor| is_real(sensor.descriptor())) {
            take(&self.sensor);
        }
        // Opening rejects a simulated transducer.
        self.force.iter().for_each(take);
        real
    }

    /// Opens the devices, and locks those that are real.
    ///
    /// # Errors
    /// [`AcquireError::OpenLive`] if a device does not open. [`AcquireError::RigTaken`] if another command uses a device. [`AcquireError::Request`] if sensor
    /// and transducer have different clocks.
    pub fn open(&self, drivers: &Drivers) -> Result<LiveDevices, AcquireError> {
        let held = HeldRigs::take(&std::env::temp_dir(), self.real(drivers))?;
        let failed = |source: OpenError| AcquireError::OpenLive(Box::new(source));
        let mut shared = Rig::new();
        let selector = || self.sensor.selector.clone();
        let sensor = Opened::open(&drivers.sensors, selector(), &mut shared).map_err(failed)?;
        let sensor_driver = sensor.descriptor.key().clone();
        let sensor_source = sensor.descriptor.source();
        let sensor_facts = sensor.descriptor.sensor().cloned().unwrap_or_default();
        let latency_ms = self.sensor.latency_ms;
        let sensor = sensor.timely(self.is_emulated, |facts| {
            latency_ms.or(facts.sensor()?.latency_ms)
        });
        let mut force = None;
        if let Some(named) = &self.force {
            let selector = named.selector.clone();
            let opened = Opened::open(&drivers.forces, selector, &mut shared).map_err(failed)?;
            let sources = [sensor_source, opened.descriptor.source()];
            if sources.iter().any(|source| *source != DriverSource::Real) {
                return Err(AcquireError::Request(format!(
                    "`{}` is {} and `{}` is {}: frames and forces are matched by the clock of this machine, which stamps real devices only; omit --force",
                    self.sensor.selector.driver(),
                    sources[0],
                    named.selector.driver(),
                    sources[1],
                )));
            }
            let driver = opened.descriptor.key().clone();
            let facts = match opened.descriptor.facts() {
                Facts::Force(facts) => *facts,
                _ => taceva_core::ForceFacts::default(),
            };
            let latency_ms = named.latency_ms;
            let mut device = opened.timely(self.is_emulated, |facts| {
                latency_ms.or(facts.force()?.latency_ms)
            });
            if let Some(axes) = self.axes {
                device = Box::new(Turned::new(device, axes));
            }
            force = Some(Transducer {
                device,
                driver,
                facts,
                zero: Wrench::default(),
            });
        }
        Ok(LiveDevices {
            sensor,
            sensor_driver,
            sensor_source,
            sensor_facts,
            force,
            is_emulated: self.is_emulated,
            traceability: self.traceability(),
            _held: held,
        })
    }
}

/// A device as the user wrote it, before its selector is parsed.
struct Wanted {
    text: String,
    latency_ms: Option<f64>,
    certificate: Option<Certificate>,
    by: String,
}

impl Wanted {
    fn read(self) -> Result<Named, AcquireError> {
        let selector = self.text.parse().map_err(|error| {
            AcquireError::Request(format!("{}: {error}", taceva_core::shown(&self.by)))
        })?;
        Ok(Named {
            selector,
            latency_ms: self.latency_ms,
            certificate: self.certificate,
            by: self.by,
        })
    }
}

/// An open sensor, with an optional transducer.
pub struct LiveDevices {
    sensor: Box<dyn Sensor>,
    sensor_driver: DriverKey,
    sensor_source: DriverSource,
    sensor_facts: SensorFacts,
    force: Option<Transducer>,
    is_emulated: bool,
    traceability: Vec<Traceability>,
    _held: HeldRigs,
}

impl LiveDevices {
    /// Size and format of every frame.
    pub fn frame_info(&self) -> FrameInfo {
        self.sensor.frame_info()
    }

    /// Facts of the sensor that its descriptor states.
    pub fn sensor_facts(&self) -> &SensorFacts {
        &self.sensor_facts
    }

    /// True if a transducer measures `axis`.
    pub fn measures(&self, axis: Axis) -> bool {
        let force = self.force.as_ref();
        force.is_some_and(|force| force.device.axes().contains(axis))
    }

    /// Instruments that measure the labels, with their certificates.
    pub(super) fn traceability(&self) -> Vec<Traceability> {
        self.traceability.clone()
    }

    /// Settings that the devices report, and the driver of a real sensor. Names of the transducer's settings begin with `force_`.
    pub(super) fn settings(&self) -> BTreeMap<String, String> {
        let mut settings = self.sensor.settings();
        let is_real = self.sensor_source == DriverSource::Real;
        settings.extend(is_real.then(|| sensor_driver(self.sensor_driver.as_str())));
        if let Some(force) = &self.force {
            add_settings(&mut settings, "force", force.device.settings());
        }
        settings
    }

    /// Exposure time of a frame, in s; `None` if the camera does not state it.
    fn exposure_s(&self) -> Option<f64> {
        let exposure_ms: f64 = self.sensor.settings().get("exposure_ms")?.parse().ok()?;
        Some(1e-3 * exposure_ms)
    }

    /// Warnings of the transducer about its readings. Each has its remedy.
    pub(super) fn device_warnings(&self) -> Vec<String> {
        let force = self.force.as_ref();
        force.map_or_else(Vec::new, |force| force.device.warnings())
    }

    /// Warnings of the transducer, and contradictions of certificates. Each has its remedy.
    pub fn warnings(&self) -> Vec<String> {
        let of_certificates = warnings_today(self.traceability(), &self.settings());
        [self.device_warnings(), of_certificates].concat()
    }

    /// True if a device is simulated or emulated. The labels are then not measurements.
    pub fn is_simulated(&self) -> bool {
        // Opening rejects a simulated transducer.
        self.is_emulated || self.sensor_source == DriverSource::Simulated
    }

    /// Starts the devices, and sets the force zero.
    pub(super) fn begin(&mut self) -> Result<(), DriverError> {
        self.sensor.start(Deadline::after(FIRST))?;
        self.force.as_mut().map_or(Ok(()), Transducer::begin)
    }

    /// Captures the first frame, without contact.
    pub(super) fn untouched(&mut self) -> Result<Frame, DriverError> {
        let info = self.sensor.frame_info();
        let mut bytes = vec![0; info.byte_len().unwrap_or_default()];
        let internal = |why: String| {
            device_error(
                ErrorKind::Internal,
                &self.sensor_driver,
                "take the first frame",
                why,
            )
        };
        let into = FrameMut::new(info, &mut bytes).map_err(|error| internal(error.to_string()))?;
        self.sensor.capture(into, Deadline::after(FIRST))?;
        Frame::new(info, bytes).map_err(|error| internal(error.to_string()))
    }

    /// Calls `act` with the streams while threads read the devices, and then stops the devices. Also returns the failure of a device, if any.
    pub(super) fn stream<T>(
        &mut self,
        predictor: Option<&LivePredictor<'_>>,
        act: impl FnOnce(&Streams<'_>) -> T,
    ) -> (T, Option<DriverError>) {
        let counts = Counts::of(self.sensor.sequence().is_some());
        let track = self
            .force
            .as_ref()
            .map(|force| Track::new(force.period_s(), self.exposure_s()));
        let failed: Mutex<Option<DriverError>> = Mutex::new(None);
        // The first failure is the cause; later ones may be its effect.
        let fail = |error: DriverError| {
            let mut failed = failed.lock().unwrap_or_else(PoisonError::into_inner);
            failed.get_or_insert(error);
            counts.end();
        };
        let (sender, queue) = sync_channel(ROOM);
        let interrupt = self.sensor.interrupt_handle();
        let camera = Camera {
            sensor: &mut *self.sensor,
            driver: &self.sensor_driver,
            source: self.sensor_source,
            counts: &counts,
            predictor,
        };
        let force = self.force.as_mut();
        let (counts, track, fail) = (&counts, track.as_ref(), &fail);
        let done = std::thread::scope(|scope| {
            scope.spawn(move || {
                if let Err(error) = camera.take(&sender) {
                    fail(error);
                }
            });
            if let (Some(force), Some(track)) = (force, track) {
                scope.spawn(move || {
                    if let Err(error) = force.read(track, counts) {
                        fail(error);
                    }
                });
            }
            if let Some(predictor) = predictor {
                scope.spawn(move || predictor.run());
            }
            let _over = Over {
                counts,
                interrupt,
                predictor,
            };
            act(&Streams {
                queue,
                track,
                counts,
            })
        });
        // A device that does not confirm its stop is stopped when it is dropped.
        drop(self.sensor.stop());
        if let Some(force) = &mut self.force {
            drop(force.device.stop());
        }
        let failed = failed.into_inner().unwrap_or_else(PoisonError::into_inner);
        (done, failed)
    }
}
