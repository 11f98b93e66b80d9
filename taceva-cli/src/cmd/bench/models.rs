//! `taceva bench models`.

use std::path::Path;

use taceva_dataset::Dataset;
use taceva_evaluate::{EvaluateError, FitRequest, subject_of};
use taceva_metrics::Isa;
use taceva_models::{ModelSettings, Models};
use taceva_report::{
    BenchMachine, BenchRecording, ChannelError, ModelBench, ModelRow, model_bench,
};
use taceva_study::bench::{Machine, ModelRace, ModelTrial, ModelTrials, TrialError, models};

use super::super::{Context, open, results};
use super::bench_recording::Pressed;
use crate::args::{BenchModels, SplitArgs};
use crate::{exit, output};

/// Models that run only if `--model` names them, because they take minutes to hours or are not separate models.
const NAMED_ONLY: [&str; 7] = [
    "cnn-ensemble",
    "resnet10",
    "resnet18",
    "resnet34",
    "smartcore/lasso",
    "smartcore/gradient-boosting",
    "auto",
];

/// Settings for a short benchmark.
const QUICK: [(&str, &str); 3] = [
    ("cnn", "epochs=20,size=32x32"),
    ("gradient-boosting", "most=60"),
    ("random-forest", "trees=30"),
];

pub(super) fn run(args: &BenchModels, context: &Context) -> anyhow::Result<u8> {
    let files = args.output.path.iter().chain(&args.figure.svg);
    output::check_all_free(files, args.output.force)?;
    let known = context.models()?;
    let requests = requests(args, &known)?;
    // Checked before the bench makes any press.
    requests.iter().try_for_each(FitRequest::check)?;
    let entered = ModelRace {
        requests: &requests,
        rounds: args.rounds,
    };
    let bench = match &args.dataset {
        Some(path) => {
            let name = path.file_name().unwrap_or(path.as_os_str());
            race(&open(path)?, &name.to_string_lossy(), entered, context)?
        }
        None => {
            let pressed = Pressed::new(args.quick, args.split.seed.value, context, &known)?;
            race(&pressed.dataset, "simulated bench", entered, context)?
        }
    };
    results::write(&bench.table(), &args.output, || bench.json())?;
    if let Some(path) = &args.figure.svg {
        draw(&bench, path)?;
    }
    Ok(exit::DONE)
}

/// Requests for one fit of each model, in the order of `--model`, or of the registry.
fn requests(args: &BenchModels, known: &Models) -> anyhow::Result<Vec<FitRequest>> {
    let quick = |name: &str| {
        let known = QUICK.iter().find(|(of, _)| args.quick && *of == name);
        known.map_or_else(
            || name.to_owned(),
            |(_, settings)| format!("{name}:{settings}"),
        )
    };
    let all = || {
        let names = known.compiled().map(|info| info.name);
        names
            .filter(|name| !NAMED_ONLY.contains(name))
            .map(quick)
            .collect()
    };
    let words: Vec<String> = if args.models.is_empty() {
        all()
    } else {
        args.models.clone()
    };
    let request = |word: &String| request(word, &args.split, known);
    words.iter().map(request).collect()
}

/// Parses the request for a fit from `word`: a model, then its settings after a colon.
pub(super) fn request(word: &str, split: &SplitArgs, known: &Models) -> anyhow::Result<FitRequest> {
    let (name, settings) = word.split_once(':').unwrap_or((word, ""));
    let settings = settings.split(',').filter(|setting| !setting.is_empty());
    let given = ModelSettings::parse(settings).map_err(EvaluateError::from)?;
    let (model, settings) = known.asked(name, given).map_err(EvaluateError::from)?;
    Ok(FitRequest {
        model,
        settings,
        channels: Vec::new(),
        split: split.split.clone(),
        seed: split.seed.value,
    })
}

fn race(
    dataset: &Dataset,
    name: &str,
    entered: ModelRace<'_>,
    context: &Context,
) -> anyhow::Result<ModelBench> {
    let trials = models(dataset, entered, context.work(None))?;
    let ModelTrials {
        rows,
        split,
        train,
        test,
    } = trials;
    let recording = recording(dataset, name, split, train, test);
    let mut bench = ModelBench::new(machine(context), recording);
    bench.rows = rows.into_iter().map(row).collect();
    Ok(bench)
}

/// Facts of this machine, with the number of threads of this command.
pub(super) fn here(context: &Context) -> Machine {
    let isa = Isa::available()
        .into_iter()
        .map(|isa| isa.name().to_owned());
    Machine::here(context.jobs.get(), isa.collect())
}

/// Description of this machine.
pub(super) fn machine(context: &Context) -> BenchMachine {
    let machine = here(context);
    BenchMachine {
        cpu: machine.cpu,
        cores: machine.cores,
        threads: machine.threads,
        isa: machine.isa,
        load: machine.load,
    }
}

/// Description of `dataset` and its split, with the numbers of training and test samples.
pub(super) fn recording(
    dataset: &Dataset,
    name: &str,
    split: String,
    train: usize,
    test: usize,
) -> BenchRecording {
    let subject = subject_of(dataset);
    BenchRecording {
        name: name.to_owned(),
        sensor: subject.sensor,
        source: subject.source,
        split,
        train: train as u64,
        test: test as u64,
    }
}

fn row(trial: ModelTrial) -> ModelRow {
    ModelRow {
        model: trial.model,
        settings: trial.settings.join(" "),
        fit_s: trial.fit_s,
        fit_cpu_s: trial.fit_cpu_s,
        predict_s: trial.predict_s,
        latency_s: trial.latency_s,
        errors: trial.errors.into_iter().map(error).collect(),
        failed: trial.failed,
    }
}

pub(super) fn error(error: TrialError) -> ChannelError {
    ChannelError {
        channel: error.channel,
        unit: error.unit,
        mae: error.mae,
        ci95: error.ci95,
        n: error.n,
        beaten_by: error.beaten_by,
    }
}

fn draw(bench: &ModelBench, path: &Path) -> anyhow::Result<()> {
    let figure = model_bench(bench)
        .ok_or_else(|| anyhow::anyhow!("no model could be scored: nothing to draw"))?;
    output::write(Some(path), |out| out.write_all(figure.svg().as_bytes()))
}
