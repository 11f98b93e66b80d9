//! Simulated bench of a plugin.

#![expect(
    unsafe_code,
    reason = "the bench is reached through the plugin's functions"
)]

use std::sync::Arc;
use std::time::Duration;

use taceva_abi as abi;
use taceva_abi::ext::{BENCH, BenchCalls};
use taceva_core::{DriverError, DriverKey, ErrorKind, GratingKind, SimulatedBench, Specimen};

use super::rig::RigHandle;
use crate::call::{Failure, Taken, call, table, take};

/// Bench `name` in a rig of a plugin.
pub(crate) struct PluginBench {
    rig: Arc<RigHandle>,
    calls: BenchCalls,
    name: String,
    plugin: DriverKey,
}

impl PluginBench {
    /// Creates the bench; `None` if the plugin has no benches. Does not check that a bench with this name is open.
    pub(crate) fn of(rig: &Arc<RigHandle>, name: &str) -> Option<PluginBench> {
        let library = rig.library();
        let extension = library.plugin().rig_extension?;
        if rig.raw().is_null() {
            return None;
        }
        // SAFETY: [owner] of an open rig: called only while a device of the rig is being opened, one at a time.
        let found = unsafe { extension(rig.raw(), abi::Text::from(BENCH)) };
        if found.is_null() {
            return None;
        }
        // SAFETY: the interface specifies this table for this id.
        let calls = unsafe { table::<BenchCalls>(found) }.ok()?;
        calls.now_ns?;
        Some(PluginBench {
            rig: Arc::clone(rig),
            calls,
            name: name.to_owned(),
            plugin: library.id().as_driver(),
        })
    }

    fn text(&self) -> abi::Text {
        abi::Text::from(&self.name)
    }

    fn call<F>(
        &self,
        doing: &'static str,
        function: Option<F>,
        run: impl FnOnce(F, &mut abi::Error) -> abi::Status,
    ) -> Result<(), DriverError> {
        let failed = |failure: Failure| failure.of(&self.plugin, doing);
        let function = function.ok_or_else(|| {
            let why =
                format!("the extension `{BENCH}` of the plugin lacks the function for this call");
            failed(Failure::new(ErrorKind::Unsupported, why))
        })?;
        call(|error| run(function, error)).map_err(failed)
    }
}

impl SimulatedBench for PluginBench {
    fn now(&self) -> Duration {
        let Some(now) = self.calls.now_ns else {
            return Duration::ZERO;
        };
        // SAFETY: [any], on a rig that `self` keeps open.
        Duration::from_nanos(unsafe { now(self.rig.raw(), self.text()) })
    }

    fn rest(&self, rest: Duration) -> Result<(), DriverError> {
        self.call("advance the time", self.calls.rest, |pass, error| {
            // SAFETY: [any], on a rig that `self` keeps open, with a text and an error that outlive the call.
            unsafe { pass(self.rig.raw(), self.text(), nanoseconds(rest), error) }
        })
    }

    fn mount(&self, specimen: Specimen) -> Result<(), DriverError> {
        let (kind, size) = match specimen {
            Specimen::Sphere { radius } => (abi::ext::Specimen::SPHERE, radius),
            Specimen::Grating { kind, spacing } => match kind {
                GratingKind::Line => (abi::ext::Specimen::LINE, spacing),
                GratingKind::Dot => (abi::ext::Specimen::DOT, spacing),
            },
        };
        let specimen = abi::ext::Specimen {
            size: u32::try_from(size_of::<abi::ext::Specimen>()).expect("a small struct"),
            kind,
            size_nm: size.0,
        };
        self.call("mount a specimen", self.calls.mount, |mount, error| {
            // SAFETY: [any], on a rig that `self` keeps open, with a text, a specimen and an error that outlive the call.
            unsafe { mount(self.rig.raw(), self.text(), &raw const specimen, error) }
        })
    }

    fn name_press(&self, name: u64) -> Result<(), DriverError> {
        self.call("name a press", self.calls.name_press, |begin, error| {
            // SAFETY: [any], on a rig that `self` keeps open, with a text and an error that outlive the call.
            unsafe { begin(self.rig.raw(), self.text(), name, error) }
        })
    }

    fn schedule(&self, at: Duration) -> Result<(), DriverError> {
        self.call("schedule a tare", self.calls.schedule, |schedule, error| {
            // SAFETY: [any], on a rig that `self` keeps open, with a text and an error that outlive the call.
            unsafe { schedule(self.rig.raw(), self.text(), nanoseconds(at), error) }
        })
    }

    fn provenance(&self) -> Option<String> {
        let mut taken = Taken::default();
        let context = taken.context();
        let said = self.call(
            "report its provenance",
            self.calls.provenance,
            |tell, error| {
                // SAFETY: [any], on a rig that `self` keeps open, with a text, a context and an error that outlive the call.
                unsafe { tell(self.rig.raw(), self.text(), Some(take), context, error) }
            },
        );
        said.ok()?;
        taken.whole().ok().filter(|text| !text.is_empty())
    }
}

fn nanoseconds(time: Duration) -> u64 {
    u64::try_from(time.as_nanos()).unwrap_or(u64::MAX)
}
