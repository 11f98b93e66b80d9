//! Minimal program with every driver: lists them, and opens the sensor that its argument selects. `.ci/driver-sizes` builds it without each
//! driver's feature in turn, to measure the size that the driver adds.

use taceva_core::Rig;
use taceva_drivers::{Drivers, devices, open};

#[expect(clippy::print_stdout, reason = "an example shows its result")]
fn main() -> Result<(), Box<dyn std::error::Error>> {
    let drivers = Drivers::builtin()?;
    match std::env::args().nth(1) {
        Some(selector) => {
            let sensor = open(&drivers.sensors, &selector.parse()?, &mut Rig::new())?;
            println!("{}", sensor.frame_info());
        }
        None => {
            for driver in devices(&drivers).drivers {
                println!("{}", driver.key);
            }
        }
    }
    Ok(())
}
