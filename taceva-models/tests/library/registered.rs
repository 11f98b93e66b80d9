//! Registered library models, and errors of a program without a library.

use taceva_models::{Form, Models, library_models};

use crate::every_model::case::case_of;
use crate::every_model::cases::LIBRARIES;

fn models() -> Models {
    Models::builtin().with_libraries(library_models())
}

#[test]
fn no_model_of_a_library_is_registered_without_being_held_to_this() {
    let registered: Vec<&str> = library_models().map(|model| model.info.name).collect();
    let held: Vec<&str> = LIBRARIES.iter().map(|case| case.name).collect();
    assert_eq!(registered, held);
}

#[test]
fn a_program_without_the_library_names_the_feature_that_it_lacks() {
    for case in LIBRARIES {
        let name = case.name;
        let bytes = case.model(&case.recording(24, 1), None).to_bytes();
        let said = Models::builtin().read(&bytes.expect("small"));
        let (library, _) = name.split_once('/').expect("library/model");
        assert_eq!(
            said.expect_err("not built in").to_string(),
            format!(
                "fitted by `{name}`: this program was built without the feature `{library}`: build it with `--features {library}`"
            )
        );
    }
    let case = case_of("linfa/pls");
    let model = case.model(&case.recording(24, 1), None);
    assert_eq!(model.card().form, Some(Form::Library));
    let library = model.card().library.as_ref().expect("of a library");
    assert_eq!(library.release, "linfa 0.8.1");
    let bytes = model.to_bytes().expect("small");
    let said = Models::builtin().read(&bytes).expect_err("not built in");
    assert_eq!(
        said.to_string(),
        "fitted by `linfa/pls`: this program was built without the feature `linfa`: build it with `--features linfa`"
    );
    let said = Models::builtin().find("smartcore/knn").expect_err("absent");
    assert_eq!(
        said.to_string(),
        "`smartcore/knn`: this program was built without the feature `smartcore`: build it with `--features smartcore`"
    );
    let said = models().find("linfa/elasticnet").expect_err("misspelt");
    assert_eq!(
        said.to_string(),
        "no model is called `linfa/elasticnet`, did you mean `linfa/elastic-net`?"
    );
}

#[test]
fn releases_are_those_of_the_lock_file() {
    let lock = include_str!("../../../Cargo.lock");
    for model in library_models() {
        let (name, version) = model.release.split_once(' ').expect("a name and a version");
        let entry = format!("name = \"{name}\"\nversion = \"{version}\"");
        assert!(lock.contains(&entry), "{}", model.release);
    }
}
