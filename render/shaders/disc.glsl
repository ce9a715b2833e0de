// Turn by the golden angle: points at its multiples with radii sqrt((k + 1/2) / n) cover a disc evenly (Vogel 1979).
const mat2 kGoldenTurn = mat2(-0.73736888, 0.67549029, -0.67549029, -0.73736888);
