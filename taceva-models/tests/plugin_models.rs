//! Models of a plugin: stored as its bytes, loaded only by the plugin, with all outputs checked.

use std::sync::Arc;

use taceva_core::{
    ArgSpec, ArgValue, Channel, Channels, DriverKey, ErrorKind, EstimatorFactory, FeatureShape,
    Features, FitRequest, FrameInfo, InputInfo, ModelError, PixelFormat, Regressor, Saved,
    SavedRegressor, SilentProgress, Targets, TrainingSet,
};
use taceva_models::{
    Color, FeatureSpec, FitInput, FormatError, Model, ModelSettings, Models, Provenance,
    SettingError,
};

static KEY: DriverKey = DriverKey::fixed("org.example.first/first");

/// Kinds of faults of the test plugin.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Way {
    Right,
    NotFinite,
    LeavesOut,
    OtherChannels,
    OtherBuild,
    Refuses,
}

/// Test estimator that always predicts the first training label plus the value of its setting.
struct First {
    way: Way,
    settings: Vec<ArgSpec>,
}

impl First {
    fn models(way: Way) -> Models {
        let add = ArgSpec::whole("add", 0, 9).default(ArgValue::Whole(0));
        let first: Arc<dyn EstimatorFactory> = Arc::new(First {
            way,
            settings: vec![add],
        });
        Models::builtin().with([first])
    }
}

struct Constant {
    way: Way,
    channels: Channels,
    shape: FeatureShape,
    value: f64,
}

impl EstimatorFactory for First {
    fn key(&self) -> &DriverKey {
        &KEY
    }

    fn title(&self) -> &str {
        "the first"
    }

    fn settings(&self) -> &[ArgSpec] {
        &self.settings
    }

    fn fit(&self, request: &FitRequest<'_>) -> Result<Box<dyn SavedRegressor>, ModelError> {
        let training = request.training;
        let channels = match self.way {
            Way::OtherChannels => Channels::new([Channel::PX]).expect("one"),
            _ => training.targets.channels.clone(),
        };
        let add = request.settings.whole("add") as f64;
        Ok(Box::new(Constant {
            way: self.way,
            channels,
            shape: training.features.shape(),
            value: training.targets.values[0] + add,
        }))
    }

    fn load(&self, saved: &Saved<'_>) -> Result<Box<dyn SavedRegressor>, ModelError> {
        let value = saved.bytes.try_into().map_err(|_| {
            ModelError::new(ErrorKind::Protocol, "these bytes are none of this model")
        })?;
        Ok(Box::new(Constant {
            way: self.way,
            channels: saved.channels.clone(),
            shape: saved.shape,
            value: f64::from_le_bytes(value),
        }))
    }

    fn build(&self) -> Result<Option<String>, ModelError> {
        let build = if self.way == Way::OtherBuild { 2 } else { 1 };
        Ok(Some(format!("sha256:{build}")))
    }

    fn admit(&self, fitted_by: Option<&str>) -> Result<(), ModelError> {
        if self.way == Way::Refuses {
            let why = format!("fitted by {fitted_by:?}");
            return Err(ModelError::new(ErrorKind::PermissionDenied, why));
        }
        Ok(())
    }
}

impl Regressor for Constant {
    fn channels(&self) -> &Channels {
        &self.channels
    }

    fn shape(&self) -> FeatureShape {
        self.shape
    }

    fn predict(&self, _: &Features, into: &mut [f64]) -> Result<(), ModelError> {
        let part = into.len() / 2;
        match self.way {
            Way::NotFinite => into.fill(f64::INFINITY),
            Way::LeavesOut => into[..part].fill(self.value),
            _ => into.fill(self.value),
        }
        Ok(())
    }
}

impl SavedRegressor for Constant {
    fn save(&self) -> Result<Vec<u8>, ModelError> {
        Ok(self.value.to_le_bytes().to_vec())
    }
}

const SPEC: FeatureSpec = FeatureSpec {
    width: 2,
    height: 1,
    color: Color::Gray,
    difference: false,
    pca: None,
    ..FeatureSpec::DEFAULT
};

/// Fits a model of one channel on six samples, by a plugin with the fault `way`.
fn fit(way: Way, words: &[&str], features: FeatureSpec) -> Result<Model, ModelError> {
    let channels = Channels::new([Channel::FZ]).expect("one");
    let values = (0..12_u8).map(f32::from).collect();
    let seen = Features::new(SPEC.shape(), values).expect("six samples");
    let labels = [3.0, 4.0, 5.0, 6.0, 7.0, 8.0];
    let settings = ModelSettings::parse(words.iter().copied()).expect("well formed");
    let chosen = First::models(way).find(KEY.as_str()).expect("offered");
    let estimator = chosen.estimator(&settings).expect("valid");
    let input = FitInput {
        estimator: &*estimator,
        settings: &settings,
        features,
        input: InputInfo::Frame(FrameInfo {
            width: 4,
            height: 2,
            format: PixelFormat::Gray8,
        }),
        training: TrainingSet::new(&seen, Targets::new(&channels, &labels)),
        validation: None,
        provenance: Provenance::default(),
    };
    Model::fit(input, &SilentProgress)
}

fn asked() -> Features {
    Features::new(SPEC.shape(), vec![0.0; 4]).expect("two samples")
}

#[test]
fn a_model_of_a_plugin_is_kept_with_who_made_it_and_comes_back_through_its_maker() {
    let model = fit(Way::Right, &["add=2"], SPEC).expect("it learns");
    assert_eq!(model.predict(&asked()).expect("finite"), [5.0, 5.0]);
    let card = model.card();
    assert_eq!(card.model, KEY.as_str());
    let plugin = card.plugin.as_ref().expect("it says whose it is");
    assert_eq!(
        [
            plugin.id.as_str(),
            &plugin.key,
            plugin.build.as_deref().expect("a library")
        ],
        ["org.example.first", KEY.as_str(), "sha256:1"]
    );
    let bytes = model.to_bytes().expect("small");
    let again = First::models(Way::Right)
        .read(&bytes)
        .expect("its own bytes");
    assert_eq!(again, model);
    assert_eq!(again.to_bytes().expect("small"), bytes);
    assert_eq!(again.predict(&asked()).expect("finite"), [5.0, 5.0]);
    // Another build may load the model if its plugin permits it; the card still names the build that fitted it.
    let other = First::models(Way::OtherBuild)
        .read(&bytes)
        .expect("admitted");
    assert_eq!(other.card().plugin, card.plugin);
}

#[test]
fn without_its_plugin_or_against_its_will_no_model_is_loaded() {
    let model = fit(Way::Right, &[], SPEC).expect("it learns");
    let bytes = model.to_bytes().expect("small");
    let error = Model::from_bytes(&bytes).expect_err("no plugin");
    assert!(
        matches!(&error, FormatError::NoPlugin { id, key } if id == "org.example.first" && key == KEY.as_str()),
        "{error}"
    );
    let error = First::models(Way::Refuses)
        .read(&bytes)
        .expect_err("refused");
    let FormatError::Content(refused) = &error else {
        panic!("{error}");
    };
    assert_eq!(refused.kind(), ErrorKind::PermissionDenied);
    assert!(error.to_string().contains("sha256:1"), "{error}");
    // Truncated bytes are rejected by the format or by the plugin.
    for length in 0..bytes.len() {
        assert!(
            First::models(Way::Right).read(&bytes[..length]).is_err(),
            "{length}"
        );
    }
}

#[test]
fn predictions_that_are_no_numbers_or_left_out_are_refused_by_their_sample_and_channel() {
    for (way, words) in [
        (Way::NotFinite, "sample 0, `Fz`: inf, expected a number"),
        (Way::LeavesOut, "sample 1, `Fz`: NaN, expected a number"),
    ] {
        let model = fit(way, &[], SPEC).expect("it learns");
        let error = model.predict(&asked()).expect_err("no numbers");
        assert_eq!(error.kind(), ErrorKind::DeviceFault);
        let said = error.to_string();
        assert!(
            said.contains(words) && said.contains(KEY.as_str()),
            "{said}"
        );
    }
}

#[test]
fn a_model_of_other_outputs_or_of_components_is_refused() {
    let error = fit(Way::OtherChannels, &[], SPEC).expect_err("another channel");
    assert!(error.to_string().contains("gives Px"), "{error}");
    assert!(error.to_string().contains("expected Fz"), "{error}");
    let components = FeatureSpec {
        pca: Some(1),
        ..SPEC
    };
    let error = fit(Way::Right, &[], components).expect_err("nobody can look into it");
    assert!(
        error.to_string().contains("principal components"),
        "{error}"
    );
}

#[test]
fn settings_and_names_of_a_plugin_are_checked_with_what_would_be_accepted_or_where_it_is_found() {
    let models = First::models(Way::Right);
    let chosen = models.find(KEY.as_str()).expect("offered");
    let settings = ModelSettings::parse(["add=12"]).expect("well formed");
    let error = chosen
        .estimator(&settings)
        .map(drop)
        .expect_err("too large");
    assert!(matches!(error, SettingError::Argument(_)), "{error}");
    let error = models.find("org.example.first/frist").map(drop);
    let error = error.expect_err("a typing mistake").to_string();
    assert!(
        error.starts_with("no available plugin has the model"),
        "{error}"
    );
    assert!(
        error.contains("did you mean `org.example.first/first`?"),
        "{error}"
    );
    for (name, said) in [
        (
            "first",
            "no model is called `first`, did you mean `org.example.first/first`?",
        ),
        (
            "org.elsewhere.median/median",
            "no available plugin has the model `org.elsewhere.median/median`: give the folder of its plugin.toml by `--plugin-dir`; `taceva plugin list` shows the plugins that are found",
        ),
    ] {
        let error = models.find(name).map(drop).expect_err("no such name");
        assert_eq!(error.to_string(), said);
    }
    assert_eq!(models.find("ridge").expect("built in").name(), "ridge");
}
