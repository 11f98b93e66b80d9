//! The smallest program that has every driver: lists them, and opens the sensor that its argument selects. `.ci/driver-sizes` builds it with each
//! driver's feature left out, which says what that driver adds to a program.

use taceva_core::Rig;
use taceva_drivers::{Drivers, devices, open};

#[expect(clippy::print_stdout, reason = "a list is what it is for")]
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
