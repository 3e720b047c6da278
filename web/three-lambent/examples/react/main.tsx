//   lambent bake model.glb -o baked.glb --keep-shadowed
//   npm install react react-dom three @react-three/fiber three-lambent && npx vite
import { createRoot } from "react-dom/client";
import { App } from "./App.js";

createRoot(document.getElementById("root")!).render(<App />);
