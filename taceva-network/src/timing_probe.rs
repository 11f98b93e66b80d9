#[cfg(test)]
mod tests {
    use crate::optimizer::*;
    struct Cpu(f64);
    impl Cpu { fn t()->f64{let t=rustix::time::clock_gettime(rustix::time::ClockId::ProcessCPUTime); t.tv_sec as f64+t.tv_nsec as f64*1e-9} fn now()->Cpu{Cpu(Cpu::t())} fn elapsed(&self)->std::time::Duration{std::time::Duration::from_secs_f64(Cpu::t()-self.0)}}
    use crate::*;
    #[test]
    #[ignore]
    fn probe() {
        let side: usize = std::env::var("SIDE").map_or(64, |s| s.parse().unwrap());
        let arch = Architecture::residual(
            Depth::Eighteen,
            Picture {
                height: side,
                width: side,
                channels: 3,
            },
            6,
        );
        let mut net = Network::new(&arch, 1).unwrap();
        let mut space = net.training_space(32);
        let draws = crate::random::Draws::new(3);
        let pic: Vec<f32> = (0..arch.input.len())
            .map(|i| draws.unit(i as u64) as f32)
            .collect();
        for i in 0..32 {
            space.input.set(i, &pic);
        }
        let mut memory = Memory::new(net.slots());
        let labels = vec![0.5; 32 * 6];
        let mut best = [1e9f64; 3];
        let mut g = vec![];
        for n in 0..6 {
            let t = Cpu::now();
            let out = net.forward(&mut space, 32);
            let loss =
                Loss::SquaredError.measure((out, 6), crate::loss::Truth::Values(&labels), &mut g);
            let f = t.elapsed().as_secs_f64();
            let mut d = Descent {
                machine: net.machine,
                optimizer: Optimizer::Sgd {
                    momentum: 0.9,
                    weight_decay: 1e-4,
                },
                rate: 0.001,
                steps: n + 1,
                memory: &mut memory,
                is_broken: false,
            };
            net.backward(&mut space, &g, &mut d);
            let a = t.elapsed().as_secs_f64();
            best[0] = best[0].min(f);
            best[1] = best[1].min(a);
            println!("{loss}");
        }
        let mut p = net.predictor();
        let pics: Vec<f32> = (0..32).flat_map(|_| pic.clone()).collect();
        let mut o = vec![0.0; 32 * 6];
        for _ in 0..5 {
            let t = Cpu::now();
            p.predict(&pics, &mut o).unwrap();
            best[2] = best[2].min(t.elapsed().as_secs_f64());
        }
        println!(
            "{side}: forward {:.1} ms, step {:.1} ms = {:.1} images/s; inference {:.1}/s",
            best[0] * 1e3,
            best[1] * 1e3,
            32.0 / best[1],
            32.0 / best[2]
        );
    }
}
