//! Faults of a gel in force and picture.

use taceva_sim::optics::{Camera, CameraSpec, OpticsSpec, View};
use taceva_sim::{GelFault, Model, Parameters};

use super::support::{contact, dn, take, view};

fn worn(model: Model, fault: GelFault, severity: u8) -> Parameters {
    let table = Parameters::worn_table(model.table(), fault, severity);
    let table = table.unwrap_or_else(|error| panic!("{model} {}: {error}", fault.name()));
    Parameters::parse(&table).expect("it was checked")
}

#[test]
fn a_softer_gel_pushes_back_less_and_a_harder_one_more() {
    for model in Model::ALL {
        let force =
            |parameters: Parameters| contact(&parameters, [0.0; 2], 0.5, [0.0; 2]).force_n[2];
        let new = force(model.parameters());
        let soft = force(worn(model, GelFault::Softening, 5));
        let warm = force(worn(model, GelFault::Temperature, 5));
        let hard = force(worn(model, GelFault::Hardening, 5));
        assert!(
            soft < warm && warm < new && new < hard,
            "{model}: {soft} {warm} {new} {hard}"
        );
    }
}

#[test]
fn scratches_move_with_the_gel_and_do_not_lie_still_in_the_picture() {
    for model in [Model::GelSight, Model::MagicTac, Model::ViTacTip] {
        let new = model.parameters();
        let pressed = contact(&new, [0.0, 0.0], 0.8, [0.5, 0.0]);
        let pictures = |parameters: &Parameters| {
            let spec = OpticsSpec {
                camera: CameraSpec::QUIET,
                ..OpticsSpec::new(parameters)
            };
            let mut camera = Camera::new(&spec, [96, 96], 0, 11).expect("small");
            [View::default(), view(pressed)].map(|view| dn(&take(&mut camera, &view).0))
        };
        let [rest, touched] = pictures(&new);
        let [worn_rest, worn_touched] = pictures(&worn(model, GelFault::Scratches, 5));
        let masks = rest
            .iter()
            .zip(&worn_rest)
            .zip(touched.iter().zip(&worn_touched));
        let mut lit = 0;
        let mut moved = 0;
        for ((rest, worn_rest), (touched, worn_touched)) in masks {
            if *rest < 4.0 || *touched < 4.0 || *worn_rest > 250.0 || *worn_touched > 250.0 {
                continue;
            }
            let [before, after] = [worn_rest / rest, worn_touched / touched];
            lit += u32::from(before > 1.02);
            moved += u32::from((after - before).abs() > 0.02);
        }
        assert!(lit > 20, "{model}: {lit} brighter pixels");
        assert!(
            moved > 5,
            "{model}: {moved} pixels changed by the motion of scratches"
        );
    }
}
