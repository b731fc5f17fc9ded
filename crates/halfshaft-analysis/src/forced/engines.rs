//! The orders of engines as tables.

use halfshaft_dynamics::engine::{CylinderOrder, REFERENCE_SPEED, cylinder_orders};
use halfshaft_model::Driveline;
use halfshaft_numerics::Complex;
use halfshaft_results::{Column, EngineOrders, Table};

/// Orders of one cylinder of each engine.
pub(super) fn tables(line: &Driveline) -> Vec<EngineOrders> {
    let engines = line.engines().iter();
    engines
        .map(|engine| {
            let orders = cylinder_orders(engine);
            let mut known: Vec<f64> = [&orders.pressure, &orders.gas, &orders.mass]
                .into_iter()
                .flat_map(|list| list.iter().map(|order| order.order))
                .collect();
            known.sort_by(f64::total_cmp);
            known.dedup();
            let mut columns = vec![Column::new("order", "1", known.clone())];
            let parts = [
                ("pressure", "Pa", &orders.pressure),
                ("gas", "N·m", &orders.gas),
                ("mass", "N·m", &orders.mass),
            ];
            for (name, unit, list) in parts.into_iter().filter(|(_, _, list)| !list.is_empty()) {
                let factor = if name == "mass" { REFERENCE_SPEED.powi(2) } else { 1.0 };
                let at = |order: &f64| value(list, *order).scaled(factor);
                let values: Vec<Complex> = known.iter().map(at).collect();
                let moduli = values.iter().map(|value| value.modulus()).collect();
                let phases = values.iter().map(|value| value.argument()).collect();
                columns.push(Column::new(name, unit, moduli));
                columns.push(Column::new(format!("{name}.phase"), "rad", phases));
            }
            EngineOrders {
                engine: engine.name.clone(),
                firing_angles: engine.firing_rad.clone(),
                table: Table::new(columns),
            }
        })
        .collect()
}

fn value(list: &[CylinderOrder], order: f64) -> Complex {
    list.iter().find(|entry| entry.order == order).map(|entry| entry.value).unwrap_or_default()
}
