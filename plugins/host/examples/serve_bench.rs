//! Opens this program's own simulated bench in a child process: `cargo run -p taceva-host --example serve_bench`.
//!
//! The child process serves the drivers that are linked into this program. It could load a plugin library instead.

#[path = "../tests/support/built_in.rs"]
mod built_in;

use std::collections::BTreeMap;
use std::error::Error;
use std::sync::Arc;
use std::time::Duration;

use built_in::BuiltIn;

use taceva_core::{Deadline, DriverKey, ErrorKind, FrameMut, Registry, Sensor};
use taceva_host::{ChildSession, ChildSpec, Session, main_if_child_with};
use taceva_sim as _;

#[expect(clippy::print_stdout, reason = "a program shows what it did")]
fn main() -> Result<(), Box<dyn Error>> {
    main_if_child_with(|_| match BuiltIn::new() {
        Ok(session) => Ok(Arc::new(session)),
        Err(error) => Err((ErrorKind::Internal, error.to_string())),
    });

    let sensors = Registry::<dyn Sensor>::builtin()?;
    let driver = sensors.get("sim/gelsight")?.descriptor();
    let arguments = BTreeMap::from([(driver.key().clone(), driver.arguments().to_vec())]);
    let plugin = DriverKey::fixed("sim");
    let session = ChildSession::start(ChildSpec::new("sim", Vec::new()), plugin, arguments)?;
    println!(
        "process {}: {}",
        session.child().process(),
        session.child().isolation()
    );

    let mut sensor = session.sensor(driver.key(), &driver.args("seed=1")?)?;
    let patience = Deadline::after(Duration::from_secs(1));
    sensor.start(patience)?;
    let info = sensor.frame_info();
    let mut bytes = vec![
        0;
        info.byte_len()
            .ok_or("the frame exceeds the address space")?
    ];
    let stamp = sensor.capture(FrameMut::new(info, &mut bytes)?, patience)?;
    println!(
        "a frame of {info} at {:?}, the first pixel is {:?}",
        stamp.valid(),
        &bytes[..3]
    );
    Ok(())
}
