//! The vibration of a line at one speed after the other.

use halfshaft_numerics::Complex;
use halfshaft_numerics::observer::Observer;
use halfshaft_results::{Column, ForcedHeat, ForcedPeak, Gear, Table};

use super::channels::{Channel, Quantity, amplitude};
use super::dampers::{Damper, dampers};
use super::synthesis::Synthesis;
use super::system::LinearLine;
use crate::error::AnalysisError;
use crate::modal::vibration::Vibration;

/// A sweep over speeds with everything that is told of it.
pub(super) struct Sweep<'v> {
    vibration: &'v Vibration,
    orders: &'v [f64],
    channels: Vec<Channel>,
    dampers: Vec<Damper>,
    /// By channel: half range at each speed.
    ranges: Vec<Vec<f64>>,
    /// By channel that is told in orders, and by order: complex amplitude at each speed.
    parts: Vec<Vec<Vec<Complex>>>,
    /// By channel: the largest half range, its speed, and the orders' moduli there.
    peaks: Vec<Peak>,
    heat: Vec<Vec<f64>>,
    speeds: Vec<f64>,
}

#[derive(Clone, Default)]
struct Peak {
    value: f64,
    speed: f64,
    order: f64,
    order_value: f64,
}

impl<'v> Sweep<'v> {
    pub(super) fn new(
        vibration: &'v Vibration,
        orders: &'v [f64],
        channels: Vec<Channel>,
        shafts: Option<&[String]>,
    ) -> Self {
        let dampers = dampers(vibration, shafts);
        let in_orders = channels.iter().filter(|channel| channel.orders).count();
        Self {
            vibration,
            orders,
            ranges: vec![Vec::new(); channels.len()],
            parts: vec![vec![Vec::new(); orders.len()]; in_orders],
            peaks: vec![Peak::default(); channels.len()],
            heat: vec![Vec::new(); dampers.len()],
            dampers,
            channels,
            speeds: Vec::new(),
        }
    }

    /// Goes through the speeds; whether to their end, which the observer may not wait for.
    pub(super) fn run(
        &mut self,
        speeds: &[f64],
        observer: &dyn Observer,
    ) -> Result<bool, AnalysisError> {
        let mut line = LinearLine::new(self.vibration)?;
        let mut synthesis = Synthesis::new(self.orders, self.channels.len());
        let mut re = vec![vec![0.0; self.channels.len()]; self.orders.len()];
        let (mut im, mut ranges) = (re.clone(), vec![0.0; self.channels.len()]);
        let mut motion = Vec::new();
        let equations = &self.vibration.equations;
        for (index, speed) in speeds.iter().enumerate() {
            if index % 64 == 0 && observer.cancelled() {
                return Ok(false);
            }
            let mut power = vec![0.0; self.dampers.len()];
            for (number, order) in self.orders.iter().enumerate() {
                let omega = order * speed;
                let torques = equations.excitation.harmonic(equations.groups(), *order, *speed);
                motion.clear();
                motion.extend(torques.into_iter().map(|(re, im)| Complex::new(re, im)));
                line.solve(omega, &mut motion);
                if omega == 0.0 && equations.rigid.is_some() {
                    // A standing excitation moves a free line away.
                    motion.fill(Complex::new(f64::NAN, f64::NAN));
                }
                for (place, channel) in self.channels.iter().enumerate() {
                    let value = amplitude(channel, omega, &motion);
                    (re[number][place], im[number][place]) = (value.re, value.im);
                }
                let dampers = self.dampers.iter().zip(&mut power);
                dampers.for_each(|(damper, power)| *power += damper.heat(omega, &motion));
            }
            synthesis.half_ranges(&re, &im, &mut ranges);
            self.keep(*speed, (&re, &im), &ranges);
            self.heat.iter_mut().zip(power).for_each(|(heat, power)| heat.push(power));
        }
        Ok(true)
    }

    fn keep(&mut self, speed: f64, (re, im): (&[Vec<f64>], &[Vec<f64>]), ranges: &[f64]) {
        self.speeds.push(speed);
        let mut in_orders = self.parts.iter_mut();
        for (place, (channel, range)) in self.channels.iter().zip(ranges).enumerate() {
            self.ranges[place].push(*range);
            if channel.orders
                && let Some(parts) = in_orders.next()
            {
                for (number, part) in parts.iter_mut().enumerate() {
                    part.push(Complex::new(re[number][place], im[number][place]));
                }
            }
            if *range > self.peaks[place].value {
                let moduli = (0..self.orders.len()).map(|n| (n, re[n][place].hypot(im[n][place])));
                let largest = moduli.max_by(|a, b| a.1.total_cmp(&b.1));
                if let Some((number, order_value)) = largest {
                    let order = self.orders[number];
                    self.peaks[place] = Peak { value: *range, speed, order, order_value };
                }
            }
        }
    }

    /// What has been gathered, as results.
    pub(super) fn into_result(self, gear: Gear) -> halfshaft_results::ForcedGear {
        let peaks = self.peaks();
        let heat = self.most_heat();
        let mut columns = vec![Column::new("frequency", "rad/s", self.speeds)];
        let mut in_orders = self.parts.into_iter();
        for (channel, ranges) in self.channels.iter().zip(self.ranges) {
            columns.push(Column::new(
                format!("{}.amplitude", channel.name),
                channel.unit(),
                ranges,
            ));
            if !channel.orders {
                continue;
            }
            for (order, values) in self.orders.iter().zip(in_orders.next().unwrap_or_default()) {
                let name = format!("{}.order{order}", channel.name);
                let moduli = values.iter().map(|value| value.modulus()).collect();
                let phases = values.iter().map(|value| value.argument()).collect();
                columns.push(Column::new(name.clone(), channel.unit(), moduli));
                columns.push(Column::new(format!("{name}.phase"), "rad", phases));
            }
        }
        for (damper, power) in self.dampers.iter().zip(self.heat) {
            columns.push(Column::new(format!("{}.heat", damper.name), "W", power));
        }
        halfshaft_results::ForcedGear { gear, table: Table::new(columns), peaks, heat }
    }

    fn peaks(&self) -> Vec<ForcedPeak> {
        let told = |channel: &Channel| {
            matches!(channel.quantity, Quantity::Torque | Quantity::Acceleration)
        };
        let rows = self.channels.iter().zip(&self.peaks).filter(|(channel, _)| told(channel));
        rows.map(|(channel, peak)| ForcedPeak {
            channel: channel.name.clone(),
            amplitude: peak.value,
            unit: channel.unit().to_owned(),
            speed: peak.speed,
            order: peak.order,
            order_amplitude: peak.order_value,
        })
        .collect()
    }

    fn most_heat(&self) -> Vec<ForcedHeat> {
        let worst = |power: &Vec<f64>| {
            let pairs = power.iter().zip(&self.speeds).filter(|(power, _)| power.is_finite());
            pairs.max_by(|a, b| a.0.total_cmp(b.0)).map(|(power, speed)| (*power, *speed))
        };
        let rows = self.dampers.iter().zip(&self.heat);
        rows.filter_map(|(damper, power)| {
            let (power, speed) = worst(power)?;
            Some(ForcedHeat { name: damper.name.clone(), power, speed })
        })
        .collect()
    }
}
