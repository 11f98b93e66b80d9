//! Measures the accuracy of closed-form shading for pictures of balls pressed into a real coated gel.
//!
//! ```text
//! cargo run --release -p taceva-sim --example shading -- FOLDER
//! ```
//!
//! FOLDER contains `labels.csv` and the pictures that it names: one of the untouched gel, and other pictures of a ball of 2.92 mm radius. Each label
//! has the place and radius of the contact, pixels. The default is the folder `gelsight-ball-depth` of `TACEVA_DATA`. Pictures without a licence are
//! only read; no part of them is written.
//!
//! Each press is scored with coefficients fitted to all other presses, so no scored picture was used in its fit.

#![expect(clippy::print_stdout, reason = "an example prints its results")]

mod law;
mod likeness;
mod press;
mod squares;

use std::error::Error;
use std::path::PathBuf;

use law::Law;
use likeness::Likeness;
use press::{Press, Presses};
use squares::Squares;

fn main() -> Result<(), Box<dyn Error>> {
    let named = std::env::args().nth(1).map(PathBuf::from);
    let data = std::env::var_os("TACEVA_DATA");
    let of_data = data.map(|folder| PathBuf::from(folder).join("gelsight-ball-depth"));
    let Some(folder) = named.or(of_data) else {
        println!(
            "skipped: no folder of ball presses; give FOLDER, or set TACEVA_DATA to its parent folder"
        );
        return Ok(());
    };
    let presses = Presses::read(&folder)?;
    let count = presses.presses.len();
    println!(
        "{count} presses of a ball; fitted to the others, each is scored once: mean (95 % of presses)"
    );
    println!("                          L1 [DN]                PSNR [dB]              SSIM");
    let untouched = |_: &Press| Ok(presses.background.clone());
    report("no contact", &presses, untouched)?;
    for law in [Law::lamps(&presses)?, Law::polynomial()] {
        let mut parts = Vec::with_capacity(count);
        for press in &presses.presses {
            let seen = presses.change(press);
            parts.push(Squares::of(&law.terms(press, &presses)?, &seen));
        }
        let whole: Squares = parts.iter().sum();
        let name = format!("{} ({} a colour)", law.name(), whole.terms());
        let mut number = 0..;
        report(&name, &presses, |press| {
            let own = number.next().and_then(|number: usize| parts.get(number));
            let others = whole.without(own.ok_or("a press has no normal equations")?);
            let change = others.solve()?.draw(&law.terms(press, &presses)?);
            Ok(presses.background.changed(&change))
        })?;
    }
    Ok(())
}

/// Prints the similarity between drawn pictures and camera pictures: over the whole picture, and around the contact.
fn report(
    name: &str,
    presses: &Presses,
    mut draw: impl FnMut(&Press) -> Result<press::Picture, Box<dyn Error>>,
) -> Result<(), Box<dyn Error>> {
    let mut whole = Vec::new();
    let mut near = Vec::new();
    for press in &presses.presses {
        let drawn = draw(press)?;
        whole.push(Likeness::of(&drawn, &press.picture));
        let window = press.surroundings();
        let [drawn, seen] = [&drawn, &press.picture].map(|picture| picture.cut(&window));
        near.push(Likeness::of(&drawn, &seen));
    }
    println!("{name:<26}{}", likeness::summary(&whole));
    println!("  within 2 contact radii  {}", likeness::summary(&near));
    Ok(())
}
