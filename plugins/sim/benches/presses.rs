//! Presses per second without pictures: contact only, and contact with its label.

use taceva_sim::{Bench, Contact, Model, Press};

fn main() {
    divan::main();
}

const PRESSES: u64 = 10_000;

fn presses(model: Model) -> (Bench, Vec<Press>) {
    let parameters = model.parameters();
    let outline = parameters.outline();
    let depth = parameters.probing.depth_max_mm;
    let share = |number: u64, step: f64| (number as f64 * step).fract();
    let presses = (0..PRESSES)
        .map(|id| Press {
            id,
            point: id / 8,
            place_mm: outline.place(share(id, 0.618_034), share(id, 0.754_878)),
            depth_mm: depth * share(id, 0.569_840),
            shear_mm: [0.3 * share(id, 0.3), -0.2],
            ..Press::default()
        })
        .collect();
    (Bench::new(parameters, 0, 1), presses)
}

#[divan::bench(args = Model::ALL)]
fn contact(bencher: divan::Bencher, model: Model) {
    let (bench, presses) = presses(model);
    bencher
        .counter(divan::counter::ItemsCount::new(PRESSES))
        .bench(|| {
            let mut force = 0.0;
            for press in &presses {
                force += bench.press(press).unwrap_or(Contact::default()).force_n[2];
            }
            force
        });
}

#[divan::bench(args = Model::ALL)]
fn contact_and_label(bencher: divan::Bencher, model: Model) {
    let (bench, presses) = presses(model);
    bencher
        .counter(divan::counter::ItemsCount::new(PRESSES))
        .bench(|| {
            let mut force = 0.0;
            for press in &presses {
                let contact = bench.press(press).unwrap_or(Contact::default());
                force += bench.label(press, &contact).force_n[2];
            }
            force
        });
}
