//! Prediction with running moments folded into the weights, so that only convolutions remain.

mod layer;
mod stages;

use self::layer::{Layer, Pass};
use self::stages::Folded;

use crate::architecture::StagePlan;
use crate::convolution::ConvolutionForm;
use crate::error::NetworkError;
use crate::head::Head;
use crate::machine::Machine;
use crate::network::Network;
use crate::picture::Picture;
use crate::planes::{Layout, Planes};
use crate::scratch::Scratch;
use crate::team::{self, Awake};

/// A network prepared for prediction, and the buffers that it needs.
#[derive(Debug)]
pub struct Predictor {
    machine: Machine,
    input: Planes,
    stages: Vec<Folded>,
    /// Number of leading stages that process only a few pictures at a time.
    light: usize,
    scratch: Scratch,
    head: Head,
    features: Vec<f32>,
    outputs: Vec<f64>,
    form: ConvolutionForm,
}

/// Number of pictures per batch.
const BATCH: usize = 32;

/// Minimum number of products of a picture for which idle threads are woken: several hundred microseconds of work.
const PRODUCTS_WORTH_WAKING: usize = 1 << 24;

/// Size of pictures between two stages that fit into a thread's second-level cache together with their inputs, in bytes.
const PICTURES_IN_CACHE: usize = 256 << 10;

impl Network {
    /// Prepares prediction with the algorithm that is fastest for many pictures at once.
    pub fn predictor(&self) -> Predictor {
        self.predictor_in(ConvolutionForm::Winograd)
    }

    /// Prepares prediction with the algorithm `form` for any number of pictures. A prediction therefore does not depend on the other pictures of a call.
    /// [`ConvolutionForm::Mixed`] is fastest for single pictures, as from a live sensor.
    pub fn predictor_in(&self, form: ConvolutionForm) -> Predictor {
        let mut layout = self.architecture.stages()[0].input_layout(self.architecture.input);
        let input = Planes::zeros(layout.picture, layout.border, BATCH);
        let plans: Vec<StagePlan> = self.architecture.stages();
        let mut stages = Vec::new();
        for (position, (plan, stage)) in self.planned().enumerate() {
            let output = plan.output(layout.picture);
            // At least one pixel even after the last stage, so a block's output has the layout of its input.
            let next = plans.get(position + 1);
            let border = next.map_or(1, |next| next.input_layout(output).border);
            stages.push(Folded::new(stage, layout, border, form));
            layout = Layout {
                picture: output,
                border,
            };
        }
        Predictor {
            machine: self.machine,
            input,
            light: stages.iter().take_while(|stage| stage.is_light()).count(),
            stages,
            scratch: Scratch::of_pictures(),
            head: self.head.clone(),
            features: Vec::new(),
            outputs: Vec::new(),
            form,
        }
    }
}

impl Predictor {
    /// Shape of an input picture.
    pub fn input(&self) -> Picture {
        self.input.layout().picture
    }

    /// Number of outputs predicted for each picture.
    pub fn outputs(&self) -> usize {
        self.head.outputs()
    }

    /// Algorithm of the convolutions.
    pub fn form(&self) -> ConvolutionForm {
        self.form
    }

    /// Predicts the outputs of each picture.
    ///
    /// # Shapes
    /// `pictures`: `[samples, height, width, channels]`. `into`: `[samples, outputs]`, allocated by the caller.
    /// # Errors
    /// [`NetworkError`] if a length differs, a value is not finite, or memory is insufficient for the transformed weights. The first call computes these
    /// weights.
    pub fn predict(&mut self, pictures: &[f32], into: &mut [f64]) -> Result<(), NetworkError> {
        let (picture, outputs) = (self.input(), self.outputs());
        picture.check_prediction(pictures, outputs, into)?;
        self.prepare()?;
        if self.is_divided(pictures.len() / picture.len()) {
            // Enters the pool once instead of once per layer.
            rayon::scope(|_| {
                let _awake = Awake::keep();
                self.pass_in_batches(pictures, into);
            });
        } else {
            self.pass_in_batches(pictures, into);
        }
        Ok(())
    }

    /// True if each picture is divided among threads. This needs fewer pictures than threads, and enough work in a picture to wake threads.
    fn is_divided(&self, pictures: usize) -> bool {
        let products: usize = self.stages.iter().map(Folded::products).sum();
        team::parts(pictures) > 1 && products >= PRODUCTS_WORTH_WAKING
    }

    fn pass_in_batches(&mut self, pictures: &[f32], into: &mut [f64]) {
        let (picture, outputs) = (self.input(), self.outputs());
        let batches = pictures.chunks(BATCH * picture.len());
        for (pictures, into) in batches.zip(into.chunks_mut(BATCH * outputs)) {
            for (position, values) in pictures.chunks_exact(picture.len()).enumerate() {
                self.input.set(position, values);
            }
            into.copy_from_slice(self.pass(pictures.len() / picture.len()));
        }
    }

    /// Transforms all weights that have not been transformed yet.
    fn prepare(&mut self) -> Result<(), NetworkError> {
        let layers = self.stages.iter_mut().flat_map(Folded::layers_mut);
        let layers: Vec<&mut Layer> = layers.collect();
        let numbers: usize = layers.iter().map(|layer| layer.missing()).sum();
        for layer in layers {
            let prepared = layer.prepare(self.machine);
            // Reports the total of all weights, although only one allocation failed.
            prepared.map_err(|_| NetworkError::Memory {
                bytes: numbers * size_of::<f32>(),
            })?;
        }
        Ok(())
    }

    /// Computes the outputs for the first `count` pictures of the input.
    fn pass(&mut self, count: usize) -> &[f64] {
        let (light, heavy) = self.stages.split_at(self.light);
        let pass = Pass {
            machine: self.machine,
            input: &self.input,
            first: 0,
            count,
        };
        let scratch = &mut self.scratch;
        let halfway = (!light.is_empty()).then(|| pass_few_at_a_time(light, pass, scratch));
        let input = halfway.as_ref().unwrap_or(&self.input);
        let seen = pass_all(heavy, Pass { input, ..pass }, scratch);
        let last = seen.as_ref().unwrap_or(input);
        self.head.see(last, count, &mut self.features);
        for passed in seen.into_iter().chain(halfway) {
            scratch.put(passed);
        }
        self.head.forward(&self.features, &mut self.outputs);
        &self.outputs
    }
}

/// Passes all pictures through one stage after another; `None` if `stages` is empty.
fn pass_all(stages: &[Folded], pass: Pass<'_>, scratch: &mut Scratch) -> Option<Planes> {
    let mut seen: Option<Planes> = None;
    for stage in stages {
        let pass = match &seen {
            None => pass,
            Some(input) => Pass {
                input,
                first: 0,
                ..pass
            },
        };
        let output = stage.pass(pass, scratch);
        if let Some(passed) = seen.replace(output) {
            scratch.put(passed);
        }
    }
    seen
}

/// Passes a few pictures at a time through all `stages`. Early stages have large pictures and few weights, and their activations then remain in cache.
fn pass_few_at_a_time(stages: &[Folded], pass: Pass<'_>, scratch: &mut Scratch) -> Planes {
    let layout = stages.last().map_or(pass.input.layout(), Folded::output);
    let few = (PICTURES_IN_CACHE / (layout.len() * size_of::<f32>())).max(1);
    let few = few * rayon::current_num_threads();
    let mut all = scratch.take(layout, pass.count);
    let groups = all
        .first_mut(pass.count)
        .chunks_mut(few * layout.len())
        .enumerate();
    for (group, into) in groups {
        let pass = Pass {
            first: group * few,
            count: into.len() / layout.len(),
            ..pass
        };
        if let Some(seen) = pass_all(stages, pass, scratch) {
            into.copy_from_slice(seen.first(pass.count));
            scratch.put(seen);
        }
    }
    all
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::architecture::{Architecture, Depth};

    #[test]
    fn pictures_that_pass_a_few_at_a_time_are_predicted_as_each_alone() {
        let input = Picture {
            height: 48,
            width: 44,
            channels: 3,
        };
        let architecture = Architecture::residual(Depth::Ten, input, 2);
        let mut predictor = Network::new(&architecture, 1)
            .expect("a network")
            .predictor();
        let few = PICTURES_IN_CACHE / (predictor.stages[1].output().len() * size_of::<f32>());
        assert_eq!(predictor.light, 2, "the stem and the first block");
        assert!((2..8).contains(&few), "{few} at a time");
        let pictures: Vec<f32> = (0_u16..)
            .map(|at| f32::from(at % 251) / 251.0)
            .take(8 * input.len())
            .collect();
        let pool = rayon::ThreadPoolBuilder::new().num_threads(1).build();
        pool.expect("a thread").install(|| {
            let (mut all, mut alone) = ([0.0; 16], [0.0; 16]);
            predictor.predict(&pictures, &mut all).expect("finite");
            let each = pictures.chunks_exact(input.len());
            for (picture, into) in each.zip(alone.chunks_exact_mut(2)) {
                predictor.predict(picture, into).expect("finite");
            }
            assert_eq!(all.map(f64::to_bits), alone.map(f64::to_bits));
        });
    }
}
