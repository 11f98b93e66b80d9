//! Rows of the session table next to a recording of a real rig.

use std::fs;

use taceva_core::Specimen;
use taceva_dataset::Session;
use taceva_drivers::MonotonicClock;
use taceva_protocol::{Plan, ReferenceTouch, SessionRecord};

/// Creates the row of a session that begins now.
pub(super) fn row(record: &SessionRecord) -> Session {
    let [zero_fx_n, zero_fy_n, zero_fz_n] = record.zero.force.map(|force| force.0);
    let [x_felt, y_felt] = record.pushes_felt;
    Session {
        boot_id: boot_id(),
        begun_s: MonotonicClock.now_s(),
        unit: record.touch.unit.clone(),
        specimen: record.touch.specimen.to_string(),
        height_mm: record.touch.height_mm,
        depth_mm: record.touch.depth_mm,
        fz_n: record.touch.force_n,
        zero_fx_n,
        zero_fy_n,
        zero_fz_n,
        x_felt,
        y_felt,
        picture_changed: record.picture_changed,
        reaction_ms: record.reaction_ms,
        overshoot_mm: record.overshoot_mm,
        height_u_mm: Some(record.touch.height_u_mm),
        fz_u_n: Some(record.touch.force_u_n),
    }
}

/// Reference touches in `sessions` with specimens of `plan`.
pub(super) fn touches(sessions: &[Session], plan: &Plan) -> Vec<ReferenceTouch> {
    let specimen = |written: &str| -> Option<Specimen> {
        let mut specimens = plan.presses.iter().map(|press| press.press.specimen);
        specimens.find(|specimen| specimen.to_string() == written)
    };
    let touches = sessions.iter().filter_map(|row| {
        Some(ReferenceTouch {
            unit: row.unit.clone(),
            specimen: specimen(&row.specimen)?,
            height_mm: row.height_mm,
            depth_mm: row.depth_mm,
            force_n: row.fz_n,
            // Without a stated uncertainty, 0 gives the strictest comparison.
            height_u_mm: row.height_u_mm.unwrap_or_default(),
            force_u_n: row.fz_u_n.unwrap_or_default(),
        })
    });
    touches.collect()
}

/// Id of the present boot of this machine, on Linux; empty on other systems. Time stamps of two boots have different clocks.
fn boot_id() -> String {
    let read = fs::read_to_string("/proc/sys/kernel/random/boot_id");
    read.map_or_else(|_| String::new(), |text| text.trim().to_owned())
}
