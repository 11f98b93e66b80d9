//! How well closed-form shading draws a real coated gel that balls are pressed into.
//!
//! ```text
//! cargo run --release -p taceva-sim --example shading -- FOLDER
//! ```
//!
//! FOLDER holds `labels.csv` and the pictures it names: one of the untouched gel and some of a ball of 2.92 mm with the place and radius of
//! its contact in pixels. Without an argument it is the folder `gelsight-ball-depth` of `TACEVA_DATA`. Pictures without a licence are
//! read where they lie; nothing of them is written.
//!
//! Every press is scored by coefficients that were fitted to all other presses, so no score is of a picture that was seen.

#![expect(clippy::print_stdout, reason = "an example talks to a person")]

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
        println!("skipped: name a folder of ball presses, or one that holds it by TACEVA_DATA");
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
            let others = whole.without(own.ok_or("a press more than was read")?);
            let change = others.solve()?.draw(&law.terms(press, &presses)?);
            Ok(presses.background.changed(&change))
        })?;
    }
    Ok(())
}

/// Prints how like the pictures that `draw` gives are to those that were taken: whole, and around the contact.
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
