"use strict";(()=>{function Fd(n,t){let[e,i]=[n.toFixed(t+30).slice(0,-30).replace(/\.$/,""),n.toFixed(t+30).slice(-30)];return/^50*$/.test(i)&&"02468".includes(e.slice(-1))?e:n.toFixed(t)}function an(n,t){if(!Number.isFinite(n))return Number.isNaN(n)?"nan":n>0?"inf":"-inf";if(n===0)return Object.is(n,-0)?"-0":"0";let[e,i]=n.toExponential(t-1).split("e"),s=Number(i),r=o=>o.includes(".")?o.replace(/\.?0+$/,""):o;return s<-4||s>=t?`${r(e)}e${s<0?"-":"+"}${String(Math.abs(s)).padStart(2,"0")}`:r(Fd(n,Math.max(t-1-s,0)))}var Ah=(n,t)=>`(${Array.from(n,e=>an(e,t)).join(", ")})`;function wh(n,t=3){if(Number.isNaN(n))return"\u2013";if(!Number.isFinite(n))return n>0?"\u221E":"\u2212\u221E";let e=Math.abs(n);if(n!==0&&!(e>=.001&&e<1e7))return an(n,t-1);let i=n===0?t:Math.max(0,t-1-Math.floor(Math.log10(e))),s=Fd(n,i);return s.includes(".")?s.replace(/\.?0+$/,""):s}function K_(n,t=3){let e=Math.abs(n);return e>=1?`${wh(n,t)} m`:e>=.001?`${wh(n*1e3,t)} mm`:`${wh(n*1e6,t)} \xB5m`}function ve(n){return n==="inf"?1/0:n==="-inf"?-1/0:typeof n=="number"?n:NaN}function Q_(n,t){if(!Number.isFinite(n))return an(n,6);let[e,i]=n.toExponential().split("e").map(String);return n!==0&&(Number(i)<-4||Number(i)>=16)?`${e}e${i[0]}${i.slice(1).padStart(2,"0")}`:Number.isInteger(n)&&t?`${n}.0`:String(n)}function Ci(n,t=!1){if(n==null)return"None";if(typeof n=="boolean")return n?"True":"False";if(typeof n=="number"||!Number.isNaN(ve(n)))return Q_(ve(n),t);if(Array.isArray(n))return`[${n.map(i=>Ci(i,t)).join(", ")}]`;if(typeof n=="object")return`{${Object.entries(n).map(([i,s])=>`'${i}': ${Ci(s,t)}`).join(", ")}}`;let e=JSON.stringify(n);return e.includes("'")?e:`'${e.slice(1,-1).replaceAll('\\"','"')}'`}var Od=80;function xn(n){if(n===void 0)return"nothing";try{let t=Ci(n);return t.length>Od?`${t.slice(0,Od-3)}...`:t}catch{return String(n)}}function xa(n,t,e=[]){return n.replace(/\{([^}:]*):?([^}]*)\}/g,(i,s,r)=>{let o=s.split(".").reduce((a,c)=>a[c],t);return r==="pocket"?e[o]:r==="s"?o:r==="m"?K_(ve(o)):r==="v"?Ah(o.map(a=>Math.abs(a)>1e-12?a:0),6):r===""?Ci(o,!0):an(ve(o),Number(r.slice(1,-1))||6)})}function Ri(n,t,e="",i=[]){let[s,r,o,a]=[n.field,n.expected,n.got,n.advice].map(c=>xa(c,t,i));return`${[e,s].filter(Boolean).join(".")}: expected ${r}${o&&`, got ${o}`}${a&&`; ${a}`}`}function ya(n,t){let e=t.map(({name:i})=>i);if(typeof n!="string"||!e.includes(n))throw new Error(`law: expected one of ${e.join(", ")}, got ${xn(n)}`)}var Eh={events:1,until:0,milliseconds:0};function Th(n){if(typeof n!="object"||n===null||Array.isArray(n))throw new Error(`limits: expected an object such as { events: 500, until: 2 }, got ${xn(n)}`);let t=Object.entries(n).flatMap(([e,i])=>{if(e==="enough")return[];if(!Object.hasOwn(Eh,e))return[`limits: expected ${Object.keys(Eh).join(", ")}, got ${xn(e)}`];let s=Eh[e],r=e!=="events"||Number.isInteger(i)||i===1/0;return i===void 0||typeof i=="number"&&i>=s&&r?[]:[`limits.${e}: expected a ${e==="events"?"whole ":""}number >= ${s}, got ${xn(i)}`]});if(t.length>0)throw new Error(t.join(`
`))}function kd(n){if(typeof n!="number"||Number.isNaN(n))throw new Error(`t: expected a time in s, such as 0.5, got ${xn(n)}`)}var Bd=n=>Array.isArray(n)&&n.length===3&&n.every(Number.isFinite);function zd(n,t,e){if(!Number.isInteger(t)||!(Number(t)>=0&&Number(t)<e))throw new Error(`ball: expected a whole number from 0 to ${e-1}, got ${xn(t)}`);if(!Array.isArray(n))throw new Error(`starts: expected a list such as [{ velocity: [1, 0, 0] }], got ${xn(n)}`);let i=n.findIndex(s=>!Bd(s?.velocity)||s.spin!==void 0&&!Bd(s.spin));if(i>=0)throw new Error(`starts[${i}]: expected a velocity and maybe a spin of three numbers each, got ${xn(n[i])}`)}var va=n=>[...n.v,...n.w,...n.n,n.radius,n.kappa,n.mass,n.e,n.mu,n.beta,n.stiffness,0,n.floor?.mu??0,n.floor?.beta??0,n.height,Number(n.together)];function Vd(n,t,e,i){let{memory:s}=n,r=s.top,[o,a]=[s.put(e),s.take(24)],c=t.flatMap(({function:l,text:h,field:u})=>{n.call(l,0,o,e.length,a,3);let[f,d,m]=s.numbers(a,3);return f!==0!==i?[]:[{field:u,text:h.replace(/\{([ab]):\.?(\d*)g\}/g,(_,p,g)=>an(p==="a"?d:m,Number(g)||6))}]});return s.top=r,c}var Ch=(n,t,e)=>Vd(n,e.conditions,va(t),!1),Gd=(n,t,e)=>Ch(n,t,e).map(({text:i})=>i);function Hd(n,t,e,i){let s=[...i.afterWall.v,...i.afterWall.w,i.required,i.requiredFloor,i.vertical??0];return Vd(n,e.objections,[...va(t),...s],!0).map(({text:r})=>r)}var tx=1e-12,ns=(n,t)=>[n[t],n[t+1],n[t+2]];function ex(n,t,e){let i=n.memory.take(48),s={stiffness_ratio:t.stiffness,floor_friction:t.floor?.mu??0,tangential_restitution:t.beta}[e.last];n.exports[e.function](...t.v,...t.w,...t.n,t.radius,t.kappa,t.e,t.mu,s,i);let r=n.memory.numbers(i,6);return{v:ns(r,0),w:ns(r,3)}}function nx(n,t,e){if(t.floor===null)return null;let{memory:i}=n,s=[...e.v,...e.w,...t.n,t.radius,t.kappa,t.floor.e,t.floor.mu,t.floor.beta,t.g,t.height],[r,o]=[i.put(s),i.take(168)];n.call("second_impact",0,r,s.length,o,21);let a=i.numbers(o,21);return{height:a[1],distance:a[2],required:a[12],rolling:{v:ns(a,14),w:ns(a,17)},why:a[20]}}function is(n,t,e,i=e){let{memory:s}=n,r=[...va(t),...e.v,...e.w,...i.v,...i.w],[o,a]=[s.put(r),s.take(48)];n.call("judge",0,o,r.length,a,6);let[c,l,h,u,f,d]=s.numbers(a,6);return{required:c,slips:l,incidence:h,afterWall:u,angle:f,kept:d}}function Rh(n,t,e){let i=nx(n,t,e);return{afterWall:e,final:i===null?e:i.rolling,required:is(n,t,e).required,requiredFloor:i===null?0:i.required,why:i===null?"":n.layout.reasons[i.why],steps:i}}function ix(n,t,e){let{memory:i,layout:s}=n,r=t.floor??{e:0,mu:0,beta:0},o=t.floor===null?1:t.height,a=[...t.v,...t.w,...t.n,t.radius,t.kappa,t.e,t.mu,t.beta,r.e,r.mu,r.beta,o,Number(e)],[c,l]=[i.put(a),i.take(112)];n.call("first_impact",0,c,a.length,l,14);let h=i.numbers(l,14),[u,f,d]=ns(h,9),m=[u*t.mass,f*t.mass,d*t.mass],_=m[2]>0?Math.hypot(m[0],m[1])/m[2]:0,p=Rh(n,t,{v:ns(h,0),w:ns(h,3)}),g=Number.isNaN(p.requiredFloor)?0:p.requiredFloor;return{...p,required:h[12],requiredFloor:Math.max(g,_>=s.limits.least_firm/2?1/0:_),withFloor:!0}}function sx(n,t,e){let i=n.layout.laws.find(({name:m})=>m===e.on_table),s=t.v[2]===0?0:t.radius,r=t.floor&&{e:0,mu:t.floor.mu,beta:0},[o,a]=[t.given.e?t.e:e.defaults.restitution??t.e,t.given.mu?t.mu:e.defaults.friction??t.mu],c=Ph(n,{...t,e:o,mu:a,beta:0,floor:r,height:s,together:!0},i),[l,h,u]=c.afterWall.v,f=Rh(n,t,{v:[l,h,t.v[2]===0&&t.n[2]<=tx?0:u],w:c.afterWall.w}),d=c.withFloor?u>0?0:c.requiredFloor:void 0;return{...f,required:c.required,requiredFloor:d??f.requiredFloor,vertical:u}}function Ph(n,t,e){let{responses:i}=n.layout;if(e.on_table!=="")return sx(n,t,e);if(e.order!=="")return ix(n,t,e.order==="scene"?t.together:e.order==="with");let s=ex(n,t,e),r={afterWall:s,final:s,why:"",steps:null};if(e.response===i.mirror)return{...r,required:0,requiredFloor:0};if(e.response===i.rolling){let o=is(n,t,s).slips;return{...r,required:o,requiredFloor:o}}return e.ignores_floor?{...r,required:is(n,t,s).required,requiredFloor:0}:Rh(n,t,s)}var Pi=n=>Number.isNaN(n)?null:n,Ih=n=>!n.v.some(Number.isNaN);function Wd(n,t,e){let i=Gd(n,t,e);if(i.length>0)return{answer:null,why:`no prediction: it requires ${i.join("; and ")}`};let s=Ph(n,t,e);return Ih(s.afterWall)?{answer:s,why:""}:{answer:null,why:`no prediction: ${s.why}`}}function rx(n,t,e){let{answer:i,why:s}=Wd(n,t,e),r={law:e.name,angle:null,angle_after_wall:null,velocity:null,spin:null,after_wall:null,energy_kept:null,hop:null,flight:null,required:null,available:t.mu,required_floor:null,available_floor:t.floor?.mu??null};if(i===null)return{...r,admissible:!1,reasons:[s]};let o=Hd(n,t,e,i),a=Ih(i.final)?i.final:null,{afterWall:c,steps:l}=i,h=is(n,t,c,i.final);return{...r,angle:a&&Pi(h.angle),angle_after_wall:Pi(h.afterWall),velocity:a&&a.v,spin:a&&a.w,after_wall:{velocity:c.v,spin:c.w},energy_kept:a&&Pi(h.kept),hop:l&&Pi(l.height),flight:l&&Pi(l.distance),required:Pi(i.required),required_floor:Pi(i.requiredFloor),admissible:o.length===0,reasons:o}}function Xd(n,t,e){let i=t.height>0,s=!i&&t.n[2]<0;return n.layout.laws.filter(o=>o.variant_of===""&&(i||!o.ignores_floor)&&(s||o.on_table===""||e.includes(o.name))).map(o=>(n.memory.clear(),rx(n,t,o)))}function $d(n,t){return n.memory.clear(),is(n,t,t).incidence}function ox(n,t){let{v:e,w:i,n:s}=n,r=Math.atan2(s[0]*e[1]-s[1]*e[0],-(s[0]*e[0]+s[1]*e[1])),a=-((r<0?-1:1)*t*Math.PI/180-r),[c,l]=[Math.cos(a),Math.sin(a)],h=([u,f,d])=>[c*u-l*f,l*u+c*f,d];return{...n,v:h(e),w:h(i)}}function qd(n,t,e,i,s){return i.map(r=>{n.memory.clear();let o=ox(e,r),{answer:a}=Wd(n,o,t),c=a&&(s==="wall"?a.afterWall:a.final);return c&&Ih(c)?Pi(is(n,o,c).angle):null})}var Pn=(n,t)=>[n[0]+t[0],n[1]+t[1],n[2]+t[2]];var en=(n,t)=>[n[0]*t,n[1]*t,n[2]*t],ss=(n,t)=>n[0]*t[0]+n[1]*t[1]+n[2]*t[2],ba=(n,t)=>[n[1]*t[2]-n[2]*t[1],n[2]*t[0]-n[0]*t[2],n[0]*t[1]-n[1]*t[0]],yn=n=>Math.hypot(n[0],n[1],n[2]),vn=n=>{let t=yn(n);return t>0?en(n,1/t):[1,0,0]};var ax=17,lx=4,[cx,hx]=[64,64],ux=256,Lh=null,Xr=new Map;function Yd(n){Lh=n,Xr.clear()}var rs=()=>{if(Lh===null)throw new Error("engine: expected carom's module to be loaded before a wall is looked at");return Lh};function Zd(n,t){let e=i=>Array.isArray(i)?i.flatMap(e):[typeof i=="boolean"?Number(i):ve(i)];return Object.entries(t).flatMap(([i,s])=>{let r=n[i]??null;return Array.isArray(s)?s.map(o=>r===null?NaN:ve(r[o])):r===null?Array(s).fill(NaN):s>0?e(r):[r.length,...e(r)]})}var fx=({panels:n},t)=>n.slice(t,t+n[t][0]+2),Jd=n=>Zd(n,rs().layout.shapes[n.shape].numbers);function Ii(n){let t=Jd(n),e=`${n.shape} ${t.map(s=>Object.is(s,-0)?"-0":s).join(" ")}`,i=Xr.get(e);return i===void 0&&(Xr.size>=ux&&Xr.clear(),i=rs().rows(`features_${n.shape}`,[t],ax,cx).map(s=>({kind:s[0],p:[s[1],s[2],s[3]],d:[s[4],s[5],s[6]],R:s[7],side:s[8],u:[s[9],s[10],s[11]],lo1:s[12],hi1:s[13],lo2:s[14],hi2:s[15],pocket:s[16],...s[0]===rs().layout.features.curve&&{rows:fx(n,s[12])}})),Xr.set(e,i)),i}function $r(n,t){let{memory:e}=rs(),i=e.top,s=Jd(n),[r,o,a]=[e.put(s),e.put(t),e.take(32)];rs().call(`place_${n.shape}`,0,r,s.length,o,3,a,4);let[c,l,h,u]=e.numbers(a,4);return e.top=i,{blocked:c!==0,vertical:l!==0,encloses:h!==0,room:u}}var os=n=>Ii(n).filter(({pocket:t})=>t>=0).map(({p:t,R:e,pocket:i})=>({name:dx(n,i),center:[t[0],t[1]],radius:e})),dx=(n,t)=>(rs().layout.shapes[n.shape].pockets??[])[t];function jd({layout:n},t,e,i){let s=e in n.parts?`part_${e}`:e,{numbers:r,faults:o,pockets:a}=n.parts[e]??n.shapes[e],c=rs().rows(`faults_${s}`,[Zd(i,r)],lx,hx).map(([h,u,f,d])=>Ri(o[h],{...i,a:u,b:f,c:d},t,a));return c.length===0&&e in n.shapes&&Ii(i).some(({p:h,d:u,R:f})=>Number.isNaN(h[0]+h[1]+h[2]+u[0]+u[1]+u[2]+f))?[Ri(n.vanishes,{},t)]:c}var px={solid:2/5,hollow:2/3},ks=n=>typeof n.inertia=="string"?px[n.inertia]:n.inertia,qr=(n,t,e)=>n.mass*ss(t,t)/2+ks(n)*n.mass*(n.radius*n.radius)*ss(e,e)/2;function Bs({gravity:n,floor:t}){let[e,i]=t?.slope??[0,0],s=-n[2];return e===0&&i===0?n:[s*e,s*i,-s*Math.sqrt(1-e*e-i*i)]}function Hn(n){let[t,e]=n.velocity;return n.rolling?[-e/n.radius,t/n.radius,n.spin_z??0]:n.spin??[0,0,0]}function Kd(n,t){let e=t.laws.find(i=>i.name===n);if(e===void 0)throw new Error(`law: expected one of ${t.laws.map(i=>i.name).join(", ")}, got ${n}`);return e}var Dh=(n,t,e)=>Kd(t.law??n.run.law,e),Uh=(n,t)=>Kd(n.ball_contact.law??"contact",t),Oh=({stiffness_ratio:n,poisson:t})=>n??2*(1-t)/(2-t);function mx(n,t){let e=n??{form:"constant",value:1},i=t.forms[e.form==="han-2005"?"polynomial":e.form];switch(e.form){case"constant":return[i,[e.value,0,0]];case"polynomial":return[i,e.coefficients];case"han-2005":return[i,t.han2005];case"power":return[i,[e.at_rest,e.speed,e.exponent]];case"viscoelastic":return[i,[e.c,0,0]];case"exponential":return[i,[e.at_rest,e.at_speed,e.speed]];default:throw new Error(`restitution: expected one of ${Object.keys(t.forms).join(", ")}, got ${e.form}`)}}function as(n,t){let[e,i]=mx(n.restitution,t);return{form:e,p:i,mu:n.friction===null?1/0:ve(n.friction),beta:n.tangential_restitution}}var Qd=(n,t)=>Object.fromEntries(Object.entries(t).map(([e,i])=>[`${n}_${e}`,i]));function gx(n,{defaults:t}){let e=n.restitution??(t.restitution===void 0?null:{form:"constant",value:t.restitution});return{...n,restitution:e,friction:n.friction??t.friction??null}}function tp(n,t,e,i){if(t.response===i.responses.contact){let{restitution:s,friction:r,tangential_restitution:o}=t.pinned;s!==void 0&&([n.form,n.p]=[i.forms.constant,[ve(s),0,0]]),r!==void 0&&(n.mu=ve(r)),o!==void 0&&(n.beta=ve(o))}return t.last==="stiffness_ratio"&&(n.beta=e),n}function _x(n,t,e,i){let s=tp(as(gx(t,e),i),e,t.stiffness_ratio,i);return e.last==="floor_friction"&&(s.beta=n.floor?as(n.floor,i).mu:0),s}function Fh(n){let t=Object.entries(n.sides??{}).filter(([,e])=>e&&((e.restitution??null)!==null||(e.friction??null)!==null));return Object.fromEntries(t.map(([e,i])=>[`sides.${e}`,{...n,restitution:i.restitution??n.restitution,friction:i.friction??n.friction}]))}function Bh(n,t,e){let i=Object.keys(e.fields.sides?.fields??{});return Fh(n)[`sides.${i[e.first_cushion-t]}`]??n}var kh=({young:n,poisson:t,overlap:e})=>e?ve(n)/(2*(1-t*t)):0;function xx({ball_contact:n},t,e,i){let s=typeof n.friction=="object"&&t.pinned.friction===void 0?n.friction:null,r=tp(as({...n,friction:s?s.at_speed:n.friction},i),t,Oh(n),i),{contact:o,called:a}=i.responses,[c,l,h]=t.slip_friction??(s?[s.at_speed,s.at_rest-s.at_speed,1/s.speed]:[r.mu,0,0]);return{...Qd("pair",{...r,mu:c}),pair_drop:l,pair_rate:h,pair_law:t.one_contact?o:a+e.indexOf(t),pair_modulus:kh(n)}}function Nh({air:n,balls:t},e,i=!1){if(!n)return{world:{},balls:t.map(()=>({}))};let s=[],r=new Map,o=t.map(c=>{let[l,h]=[c.radius,2*c.radius*n.density/n.viscosity],u=!1,f=["drag","lift"].map(m=>{let _=c[m]??0,g=(typeof _=="string"?e.air_laws[_][m]:[[_,0,0,0,0,0,1/0,0]]).map(([b,v,w,E,y,M,L,R])=>{let D=ve(L);return[Number(R),R?D:D/h,b,v*h,w/h,E/(h*h),y,M]});u||=g.some(b=>b.slice(2).some(v=>v!==0));let x=(i?r.get(JSON.stringify(g)):void 0)??s.length/8;return x===s.length/8&&s.push(...g.flat()),r.set(JSON.stringify(g),x),{[m]:x,[`${m}_last`]:x+g.length-1}}),d=n.density*4/3*Math.PI*(l*l*l)/c.mass;return{...f[0],...f[1],air:u?n.density*Math.PI*(l*l)/(2*c.mass):0,buoyancy:n.buoyancy?d:0,spin_decay:c.spin_decay??0}}),a=e.records.world.fields.laws.count;return s.length>a&&!i?Nh({air:n,balls:t},e,!0):{world:{wind:n.wind,laws:s},balls:o}}function Li(n,t){let{layout:e,memory:i}=t,{rim:s,curve:r}=e.features,o=n.floor,a=n.walls.map(p=>Dh(n,p,e)),c=Uh(n,e),l=a.filter(p=>p.response===e.responses.called),h=[...new Set(c.one_contact?l:[...l,c])],u={force:Bs(n),...o&&{floor:1,g:-Bs(n)[2],...Qd("floor",as(o,e))},...o&&{resistance:o.rolling_resistance,spin_friction:o.spin_friction},...o&&{rolling_drag:o.rolling_drag,spin_damping:o.spin_damping,spin_drag:o.spin_drag},...xx(n,c,h,e),together:n.run.floor_contact==="with",...Nh(n,e).world},f=0,d=n.walls.flatMap((p,g)=>{let x=a[g],b=x.response+(x.response===e.responses.called?h.indexOf(x):0),{leaves:v,falls:w,goes_on:E}=e.gates,y={wall:g,contact_time:p.contact_time,yield_time:p.yield_time,law:b},M=$r(p,[0,0,0]).encloses?v:E;return Ii(p).map(({pocket:L,rows:R,...D})=>{let{form:N,p:B,mu:C,beta:z}=_x(n,Bh(p,L,e),x,e),$={...y,form:N,e:B,mu:C,beta:z};if(L>=0)return{...D,...$,ends:w,at:f++};let G={[s]:"rim",[r]:"arc"}[D.kind];return{...D,...$,ends:M,at:G?t.address(G):0,...R&&{lo1:i.put(R.flat())}}})}),m=Nh(n,e).balls,_=n.balls.map((p,g)=>({...m[g],radius:p.radius,mass:p.mass,kappa:ks(p),x:zh(n,p),v:p.velocity,w:Hn(p)}));return{world:u,features:d,balls:_,called:h}}function zh(n,t){let[e,i,s]=t.position;return[e,i,s??(n.floor?t.radius:0)]}var yx=2e3,vx=2e3,bx=256,ep=128,Mx=4096;function np(n,t){let{memory:e,layout:i}=n,{records:s}=i;e.clear();let r=Li(t,n),o=e.records(s.world,[r.world]),a=e.records(s.features,r.features),c=e.records(s.balls,r.balls),l=e.take(8*Math.max(r.called.length,1));return r.called.forEach((h,u)=>e.putWhole(l+8*u,n.address(h.function))),{world:o,features:a,count:r.features.length,balls:c,users:l,called:r.called.length,out:e.take(64)}}var Vh=(n,t,e)=>ip(n,t,np(n,t),e);function ip(n,t,{world:e,features:i,count:s,balls:r,users:o,called:a,out:c},l){let{memory:h,layout:u}=n,{records:f,run:d}=u,m=t.balls.length,_=l.until??t.run.duration??1/0,p=Math.min(l.events??yx,t.run.max_events??1/0),g=performance.now()+(l.milliseconds??vx),x=[],[b,v,w,E,y,M]=[-1,0,d.full,-1,0,ep+m];for(;w===d.full;){let N=h.take(M*f.log.bytes),B=Math.min(p-v,bx);n.call("run",c,e,1,i,s,r,m,N,M,b,_,B,o,a,d.all);let C=h.words.subarray(c/4);w=C[0],v+=C[2],E=C[6],[b,y]=h.numbers(c+32,2);let z={at:N,rows:C[4]};x.push(z),M=Math.min(4*M,Mx);let $=l.enough?.(z);w===d.full&&$?w=d.limit:w===d.limit&&v<p&&performance.now()<g&&!$&&(w=d.full)}let R={[d.done]:"done",[d.quiet]:"quiet",[d.limit]:v<p?"time":"limit"}[w]??"refused",D=R==="done"&&_===1/0?"quiet":R;return{world:e,features:i,balls:r,logs:x,status:D,code:w,end:D==="done"?_:y,atFault:E}}function sp(n,t,e,i,s){let{memory:r,layout:o}=n,{balls:a,log:c}=o.records,l=np(n,t),[h,u]=[r.top,l.balls+e*a.bytes],f=new Uint8Array(r.memory.buffer,l.balls,t.balls.length*a.bytes).slice();return i.map(({velocity:d,spin:m})=>{r.top=h,new Uint8Array(r.memory.buffer).set(f,l.balls);let _={...t.balls[e],velocity:d,...m&&{spin:m,rolling:!1}};r.set(a,u,"v",d),r.set(a,u,"w",Hn(_));let{logs:p}=ip(n,t,l,s),[g,x,b,v]=["t","met","ball","other"].map(w=>r.field(c,w));return p.flatMap(({at:w,rows:E})=>{let y=[];for(let M=w;M<w+E*c.bytes;M+=c.bytes){let L=o.kinds[x(M)];L!=="nothing"&&y.push({t:g(M),met:L,ball:b(M),other:v(M)})}return y})})}function rp(n,t,e){let i=Vh(n,t,e),{status:s,code:r,balls:o,atFault:a}=i,c=s==="refused"?Tx(n,t,r,o,a):"";return{...Gh(n,t,i),why:c}}function Gh(n,t,{world:e,balls:i,logs:s,status:r,end:o}){let{memory:a,layout:c}=n,{balls:l,log:h}=c.records,u=Ex(n,s),f=r==="quiet"?1/0:o,d=s.reduce((x,b)=>x+b.rows,0),m=s.length===1?s[0].at:Ax(n,s,d*h.bytes),_=a.take(72),p=t.balls.map((x,b)=>{let v=n.rows("pieces",[e,1,i+b*l.bytes,1,m,d,b,f,o,_,9],Sx,ep),[w,E,y]=[0,3,6].map(M=>a.numbers(_+8*M,3));return{pieces:v.map(M=>wx(M,c.phases)),x:w,v:E,w:y}}),g=x=>u.findLast(b=>b.ball===x)?.phase??"";return{status:r,why:"",until:o,events:u.slice(t.balls.length),balls:p.map(({pieces:x})=>({pieces:x})),final:p.map(({x,v:b,w:v},w)=>({x,v:b,w:v,phase:g(w)}))}}var Sx=18,wx=(n,t)=>({t:n[0],lasts:n[1],x:[n[2],n[3],n[4]],v:[n[5],n[6],n[7]],w:[n[8],n[9],n[10]],acc:[n[11],n[12],n[13]],turn:[n[14],n[15],n[16]],phase:t[n[17]]});function Ax({memory:n,layout:t},e,i){let s=n.take(i),r=s;for(let{at:o,rows:a}of e){let c=a*t.records.log.bytes;new Uint8Array(n.memory.buffer).copyWithin(s,o,o+c),s+=c}return r}function Ex(n,t){let{layout:e,memory:i}=n,{kinds:s,phases:r,regimes:o,records:a}=e,l=Object.fromEntries(["t","kind","ball","met","other","x","v_before","w_before","v","w","phase_before","phase","impulse","floor_impulse","required","regime"].map(u=>[u,i.field(a.log,u)])),h=[];for(let u of t)for(let f=0;f<u.rows;f++){let d=u.at+f*a.log.bytes,m=r[l.phase(d)],_=s[l.kind(d)],p=s[l.met(d)],g=l.regime(d);h.push({t:l.t(d),kind:_==="phase"?m:_,ball:l.ball(d),met:p==="nothing"?null:p,other:l.other(d),x:l.x(d),v_before:l.v_before(d),w_before:l.w_before(d),v:l.v(d),w:l.w(d),phase_before:r[l.phase_before(d)],phase:m,impulse:l.impulse(d),floor_impulse:l.floor_impulse(d),required:l.required(d),regime:g<0?null:o[g]})}return h}function Tx(n,t,e,i,s){let{memory:r,layout:o}=n,a=i+s*o.records.balls.bytes,[c,l]=["clock","x"].map(u=>r.field(o.records.balls,u)(a));return`${t.balls[s].name??`ball ${s}`}: expected an event that its law has an answer for, got one at t = ${an(c,6)} s, x = ${Ah(l,4)}: ${o.refusals[e]}`}function Cx(n,t){let{memory:e,layout:i}=n,s=i.records.log,[r,o,a]=["kind","ball","other"].map(m=>e.field(s,m)),c=(m,_)=>o(m)===0&&i.kinds[r(m)]===_,l=m=>Array.from({length:m.rows},(_,p)=>m.at+p*s.bytes),{logs:h}=Vh(n,t,{enough:m=>l(m).some(_=>c(_,"wall"))}),u=h.flatMap(l),f=u.findIndex(m=>c(m,"wall")),d=f<0?u:u.slice(0,f);return{hit:f<0?void 0:u[f],balls:new Set(d.filter(m=>c(m,"ball")).map(a))}}function op(n,t){let{memory:e,layout:i}=n,s=i.records.log,{hit:r,balls:o}=Cx(n,t);if(r===void 0)throw new Error(Rx(t,o.size));let[a,c,l,h,u]=["t","x","v_before","w_before","other"].map(C=>e.field(s,C)(r)),f={...t,run:{...t.run,law:"two-step"},walls:t.walls.map(C=>({...C,law:null}))};e.clear();let d=Li(f,n),m=e.records(i.records.features,d.features),_=e.records(i.records.balls,[{...d.balls[0],x:c,v:l,w:h}]),p=e.take(8*d.features.length);n.call("gaps",0,m,d.features.length,_,1,p,1,d.features.length);let g=-1;e.numbers(p,d.features.length).forEach((C,z)=>{let $=g<0||Math.abs(C)<Math.abs(e.doubles[p/8+g]);d.features[z].wall===u&&Number.isFinite(C)&&$&&(g=z)});let x=e.take(40);n.call("meet",0,m+g*i.records.features.bytes,1,_,1,x,5);let[b,v,w,E,y]=e.numbers(x,5),M=d.features.findIndex(C=>C.wall===u),[L,{radius:R,mass:D}]=[Bh(t.walls[u],Ii(t.walls[u])[g-M].pocket,i),t.balls[0]],{mu:N,beta:B}=as(L,i);return{given:{e:L.restitution!==null,mu:L.friction!==null},t:a,wall:u,balls:o.size,radius:R,mass:D,kappa:Number(d.balls[0].kappa),v:l,w:h,n:[b,v,w],e:y,mu:N,beta:B,stiffness:L.stiffness_ratio,floor:t.floor&&Px(n,t.floor,E),g:t.floor?-Bs(t)[2]:0,height:t.floor?Math.max(c[2]-R,0):1/0,together:t.run.floor_contact==="with"}}var Hh=n=>n===1?"another ball":`${n} other balls`;function Rx(n,t){let e=n.balls[0].name??"the first ball",i=n.walls.length===0?"this scene has none":t>0?`here it meets ${Hh(t)} and no wall`:"here it meets none";return`The laws are compared at the first wall that ${e} meets; ${i}.`}function Px(n,t,e){let{form:i,p:s,mu:r,beta:o}=as(t,n.layout),[a,c]=[n.memory.put([i,...s,Math.max(e,0)]),n.memory.take(8)];return n.call("restitution",0,a,5,c,1),{e:n.memory.numbers(c,1)[0],mu:r,beta:o}}var Ma=class{constructor(t,e){this.memory=t,this.base=Math.ceil(e/16)*16,this.top=this.base,this.doubles=new Float64Array(t.buffer),this.words=new Int32Array(t.buffer)}clear(){this.top=this.base}take(t){let e=this.top;if(this.top=Math.ceil((e+t)/16)*16,this.top>268435456)throw new Error("engine: expected a run that fits into 256 MB, got a larger one; ask for fewer events");let i=this.top-this.memory.buffer.byteLength;return i>0&&this.memory.grow(Math.ceil(i/65536)),this.doubles.buffer!==this.memory.buffer&&(this.doubles=new Float64Array(this.memory.buffer),this.words=new Int32Array(this.memory.buffer)),new Uint8Array(this.memory.buffer,e,this.top-e).fill(0),e}put(t){let e=this.take(8*Math.max(t.length,1));return this.doubles.set(t,e/8),e}numbers(t,e){return Array.from(this.doubles.subarray(t/8,t/8+e))}putWhole(t,e){this.words[t/4]=e,this.words[t/4+1]=e<0?-1:0}records(t,e){let i=this.take(t.bytes*Math.max(e.length,1));return e.forEach((s,r)=>{for(let[o,a]of Object.entries(s))this.set(t,i+r*t.bytes,o,a)}),i}set(t,e,i,s){let r=t.fields[i];typeof s=="object"?this.doubles.set(s,(e+r.at)/8):r.whole?this.putWhole(e+r.at,Number(s)):this.doubles[(e+r.at)/8]=Number(s)}field(t,e){let{at:i,count:s,whole:r}=t.fields[e];return s===1?c=>r?this.words[(c+i)/4]:this.doubles[(c+i)/8]:c=>{let l=(c+i)/8,h=this.doubles;return[h[l],h[l+1],h[l+2]]}}};var Wh=class{constructor(t,e){let i=t.exports;this.exports=i,this.layout=e,this.memory=new Ma(i.memory,i.__heap_base.value)}call(t,e,...i){this.exports[t](e,...i)}rows(t,e,i,s){let{memory:r}=this,o=r.top,a=e.flatMap(f=>typeof f=="number"?f:Array.isArray(f)?[r.put(f),f.length]:[r.put(f.rows.flat()),f.rows.length,f.columns]),[c,l]=[r.take(8),r.take(8*i*s)];this.call(t,c,...a,l,s,i);let h=r.words[c/4],u=Array.from({length:Math.min(h,s)},(f,d)=>r.numbers(l+8*i*d,i));return r.top=o,h>s?this.rows(t,e,i,h):u}address(t){return this.exports[`address_of_${t}`]()}};async function Sa(n,t){if(typeof WebAssembly>"u")throw new Error("expected a browser with WebAssembly, got one without; any browser of the last years has it");let e=new Uint8Array(n),i=await WebAssembly.compile(e).catch(a=>{throw new Error(`engine.wasm: expected carom's module, got one that the browser refuses: ${a.message}`)}),[s]=WebAssembly.Module.customSections(i,"carom"),r=s===void 0?"none":new TextDecoder().decode(s);if(r!==t.version)throw new Error(`engine.wasm: expected the module of version ${t.version}, got version ${r}; build both anew with make wasm`);let o=new Wh(await WebAssembly.instantiate(i),t);return Yd(o),o}var Ix={quiet:"nothing more happens",done:"duration",limit:"max_events",time:"time of computing",refused:"refused"},Lx=n=>Number.isFinite(n)?n:null;function wa(n,t){let e=n.walls.map((s,r)=>s.name||`${s.shape} ${r}`),i=n.balls.map((s,r)=>s.name||`ball ${r}`);return{events:t.events.map(s=>({t:s.t,kind:s.kind,ball:s.ball,position:s.x,velocity:s.v,spin:s.w,other:s.other,name:s.met==="wall"?e[s.other]:s.met==="ball"?i[s.other]:"",phase:s.phase,impulse:s.impulse,required_friction:Lx(s.required),energy_lost:qr(n.balls[s.ball],s.v_before,s.w_before)-qr(n.balls[s.ball],s.v,s.w)})),final:t.final.map(({x:s,v:r,w:o,phase:a},c)=>({position:s,velocity:r,spin:o,phase:a,name:i[c]})),end:t.until,ended:Ix[t.status]}}var[Xh,$h]=[1e-100,1e100],cs=n=>typeof n=="object"&&n!==null&&!Array.isArray(n);function Nx(n,{what:t,least:e,most:i,above:s,infinite:r,words:o}){if(typeof n=="string"&&o?.includes(n))return"";let a=ve(n),c=Math.abs(a),l=s?a>(e??-1/0):a>=(e??-1/0),h=(!s||c>=Xh)&&c<=$h;return l&&a<=(i??1/0)&&(h||r&&c===1/0)?"":c>$h&&c<1/0?`${t}, at most ${an($h,6)} in size`:c>0&&c<Xh?`${t}, at least ${an(Xh,6)} in size`:t}function ls(n,t,e,i){let{fields:s}=n.layout;if(i.optional&&e==null)return[];if(i.of)return ls(n,t,e,s[i.of]);let{kind:r,what:o,each:a}=i,c=(f=o,d=e,m=t)=>[`${m||"scene"}: expected ${f}, got ${xn(t===""?d??void 0:d)}`],l=(f,d)=>f.flatMap((m,_)=>ls(n,`${t}[${_}]`,m,d)),h=f=>t===""?f:`${t}.${f}`;if(r==="part"){if(!cs(e))return c();let f=Object.entries(i.fields??{}),d=[...f.flatMap(([m,_])=>ls(n,h(m),e[m],_)),...Object.keys(e).filter(m=>!f.some(([_])=>_===m)).flatMap(m=>c("a field that is known here",m,h(m)))];return d.length===0&&i.rules?jd(n,t,i.rules,e):d}if(r==="tagged"){let[f,d]=[i.tag,i.options??{}];return cs(e)?Object.hasOwn(d,e[f])?ls(n,t,e,d[e[f]]):[`${h(f)}: expected one of ${Object.keys(d).join(", ")}, got ${xn(e[f])}`]:c(o??"a table of fields")}if(r==="list"||r==="vector"){if(!Array.isArray(e))return c();if(i.least&&e.length===0)return[`${t}: expected ${i.least}, got none; a file has a table [[${t}]] for each`];let[f,d]=i.counts??[0,1/0];if(e.length<f||e.length>d)return c();let m=l(e,a);return m.length===0&&i.nonzero&&e.every(_=>_===0)?[`${t}: expected a direction, not all zero, got ${Ci(e,!0)}`]:m}if(r==="number"){if(i.part&&cs(e))return ls(n,t,e,s[i.part]);let f=Nx(e,i);return f?c(f):[]}return{flag:typeof e=="boolean",text:typeof e=="string",choice:i.values?.includes(e),whole:Number.isSafeInteger(e)&&e>=Number(i.least)}[r]?[]:c()}var ap=7;function lp(n,t){let{layout:e,memory:i}=n,s=ls(n,"",t,e.fields.scene);if(s.length>0)return s;let{balls:r,walls:o,ball_contact:a}=t;i.clear();let{features:c}=Li(t,n);for(let[v,w]of Object.entries({balls:r.length,"features of walls":c.length})){let E=e.limits[v];w>E&&s.push(`${v}: expected at most ${E.toLocaleString("en")}, got ${w.toLocaleString("en")}; carom simulate takes more`)}if(s.length>0)return s;let l=r.map((v,w)=>v.name||`ball ${w}`),h=r.map(v=>zh(t,v)),u=r.map((v,w)=>[...h[w],v.radius,Number(v.rolling),l.indexOf(l[w]),+!!v.name,yn(v.velocity),v.mass]),f=o.map(v=>h.map(w=>$r(v,w))),d=o.map((v,w)=>[+(v.shape==="plane"),f[w][0].room,v.nose_height??NaN]),m=f.map(v=>v.map(w=>Number(w.blocked))),_=([v,w,E,y,M,L,R])=>Ri(e.scene_faults[v],{...t,i:w,k:E,a:y,b:M,c:L,d:R,place:[M,L,R],ball:{...r[w],center:h[w]},name:l[w],wall:o[E]&&Dx(o[E],E)}),p=[...t.gravity,+(t.floor!==null),o.findIndex(({shape:v})=>v==="table")],[g,x]=[(v,w)=>({rows:v,columns:w}),r.length],b=[[ve(a.young),kh(a)],g(u,9),g(d,3),i.records(e.records.features,c),c.length,g(m,x)];return[...n.rows("faults_on_floor",[p,g(u,9)],ap,x+1).map(_),...Ux(n,t),...n.rows("faults_at_walls",b,ap,64).map(_)]}var Dx=(n,t)=>`walls[${t}] (${n.name||`${n.shape} ${t}`})`;function Ux(n,t){let{layout:e}=n,i=t.ball_contact;return[...t.walls.flatMap((s,r)=>{let[o,a]=[Dh(t,s,e),`walls[${r}]`],c=o.needed.filter(({name:u})=>s[u]===null).map(u=>Ri(e.law_faults.needed,{at:a,...u})),l=u=>$r(s,[0,0,u]).vertical,h=Object.entries(Fh(s)).flatMap(([u,f])=>qh(n,t,f,o,`${a}.${u}`,{},f.stiffness_ratio,l).filter(d=>d.startsWith(`${a}.${u}.restitution`)));return[...c,...qh(n,t,s,o,a,{shape:a,floor:s.law?`${a}.law`:"run.law"},s.stiffness_ratio,l),...h]}),...qh(n,t,{...i,shape:""},Uh(t,e),"ball_contact",{},Oh(i))]}function qh(n,t,e,i,s,r,o,a=()=>!0){let{law_faults:c}=n.layout,l=e.restitution,h=l===null?1:l.form==="constant"?Number(l.value):.5,u=new Map;for(let p of t.balls)for(let{field:g,text:x}of Ch(n,{v:[-1,0,0],w:[0,t.floor?-1/p.radius:0,0],n:a(p.radius)?[1,0,0]:[.8,0,.6],radius:p.radius,kappa:ks(p),mass:p.mass,e:h,mu:1/0,beta:0,stiffness:o,floor:{e:0,mu:1/0,beta:0},height:0,together:!0},i))u.has(g)||u.set(g,x);let f=l===null?"":l.form==="constant"?an(h,6):xa(c.restitution.got,l),d={shape:xa(c.shape.got,e),floor:c.floor.got,restitution:f,stiffness_ratio:Ci(o,!0)},m=[...u].filter(([p])=>r[p]||p==="restitution"||p==="stiffness_ratio"),_=i.last==="stiffness_ratio"&&e.tangential_restitution!==0;return[...m.map(([p,g])=>Ri(c.unmet,{at:r[p]??`${s}.${p}`,expected:g,law:i.name,got:d[p]})),..._?[Ri(c.springs,{at:s,law:i.name,beta:e.tangential_restitution})]:[]]}async function hp(n,t){return new Yr(await Sa(n,t))}var Yr=class{constructor(t){this.module=t,this.version=t.layout.version,this.laws=t.layout.laws}faults(t){return lp(this.module,t)}run(t,e,i={}){return Th(i),e!==void 0&&ya(e,this.laws),rp(this.module,this.checked(e===void 0?t:cp(t,e)),i)}report(t,e,i={}){return wa(t,this.run(t,e,i))}shots(t,e,{ball:i=0,law:s,...r}={}){Th(r),s!==void 0&&ya(s,this.laws);let o=this.checked(s===void 0?t:cp(t,s));return zd(e,i,o.balls.length),sp(this.module,o,i,e,r)}checked(t){let e=this.faults(t);if(e.length>0)throw new Error(e.join(`
`));return t}compare(t,e=[]){return this.compareAt(this.meeting(t),e)}compareAt(t,e=[]){return Xd(this.module,t,e)}incidenceAt(t){return $d(this.module,t)}meeting(t){return op(this.module,this.checked(t))}curve(t,e,i,s="final"){return this.curveAt(t,this.meeting(e),i,s)}curveAt(t,e,i,s="final"){ya(t,this.laws);let r=this.laws.find(o=>o.name===t);return qd(this.module,r,e,i,s)}},Ox=n=>cs(n)&&cs(n.run)&&Array.isArray(n.walls)&&n.walls.every(cs),cp=(n,t)=>Ox(n)?{...n,run:{...n.run,law:t},walls:n.walls.map(e=>({...e,law:null}))}:n;async function up(n,t,e,i){return new Yh(await Sa(n,t),e,await Fx(i.log),i)}async function Fx(n){if(typeof DecompressionStream>"u")throw new Error("This browser cannot unpack the run in this page: any browser since May 2023 can.");let t=Uint8Array.from(atob(n),i=>i.charCodeAt(0)),e=new Blob([t]).stream().pipeThrough(new DecompressionStream("gzip"));return new Uint8Array(await new Response(e).arrayBuffer())}var Yh=class extends Yr{constructor(t,e,i,s){super(t);let{memory:r,layout:o}=t;r.clear();let a=Li({...e,walls:[]},t),c=r.records(o.records.world,[a.world]),l=r.records(o.records.balls,a.balls),h=r.take(i.length);new Uint8Array(r.memory.buffer,h,i.length).set(i);let u=[{at:h,rows:i.length/o.records.log.bytes}];this.found=Gh(t,e,{world:c,balls:l,logs:u,status:s.status,end:s.end}),this.why=s.why,this.scene=e}faults(){return[]}run(){return this.found}report(){return wa(this.scene,this.found)}meeting(t){try{return super.meeting(t)}catch{throw new Error(this.why)}}};function Kt(n,t={},...e){let i=document.createElement(n);for(let[s,r]of Object.entries(t))typeof r=="function"?i.addEventListener(s,r):r===!0?i.setAttribute(s,""):r!==!1&&i.setAttribute(s,r);return i.append(...e),i}function He(n,t={},...e){let i=document.createElementNS("http://www.w3.org/2000/svg",n);for(let[s,r]of Object.entries(t))i.setAttribute(s,String(r));return i.append(...e),i}function $t(n){let t=document.getElementById(n);if(!t)throw new Error(`the page has no element ${n}`);return t}function Ge(n,t=3){return n==null||Number.isNaN(n)?"\u2013":n===1/0?"\u221E":n===-1/0?"\u2212\u221E":Math.abs(n)<1e-9?"0":(Math.abs(n)>=10**t?n.toFixed(0):String(Number(n.toPrecision(t)))).replace("-","\u2212")}function fp(n){let t=Math.abs(n);return t<1e-9?"0 mm":t<.001?`${Ge(n*1e6)} \xB5m`:t<1?`${Ge(n*1e3)} mm`:`${Ge(n)} m`}var Zr=n=>n!==0&&Math.abs(n)<.1?`${Ge(n*1e3)} ms`:`${n.toFixed(3)} s`;var hs=n=>n==null?1/0:ve(n),gp=n=>n===1/0?"inf":n===-1/0?"-inf":n,Ta=Math.PI/180;function bn(n,t,e){return{...n,balls:n.balls.map((i,s)=>s===t?{...i,...e}:i)}}function _p(n,t,e){return{...n,walls:n.walls.map((i,s)=>t<0||s===t?e(i):i)}}function Ra(n){let t=n.walls.find(s=>s.shape==="plane");if(!t)return null;let e=vn(t.normal),i=Math.hypot(e[0],e[1]);return i>.3?[e[0]/i,e[1]/i,0]:null}function dp(n,t){let[e,i]=n.balls[t].velocity;if(e===0&&i===0)return 0;let s=Ra(n);return s?Math.atan2(i*s[0]-e*s[1],-(e*s[0]+i*s[1]))/Ta:Math.atan2(i,e)/Ta}function pp(n,t,e,i){let s=Ra(n),r=Math.cos(i*Ta)*e,o=Math.sin(i*Ta)*e,a=n.balls[t].velocity[2];return bn(n,t,{velocity:s?[-r*s[0]-o*s[1],-r*s[1]+o*s[0],a]:[r,o,a]})}function Jr(n,t,e){let i=n.balls[t];if(!e)return bn(n,t,{rolling:e,spin:Hn(i),spin_z:null});let[s,r]=i.velocity,[o,a]=i.position;return bn(n,t,{rolling:e,spin:null,spin_z:Hn(i)[2],velocity:[s,r,0],position:[o,a,i.radius]})}function xp({velocity:[n,t]}){let e=Math.hypot(n,t),[i,s]=e>0?[n/e,t/e]:[1,0];return{top:[-s,i,0],way:[i,s,0]}}function Ca(n,t){let e=xp(n)[t],i=Hn(n);return i[0]*e[0]+i[1]*e[1]}function mp(n,t,e,i){let s=n.balls[t],r=xp(s),o=e==="top"?i:Ca(s,"top"),a=e==="way"?i:Ca(s,"way"),c=[0,1].map(h=>o*r.top[h]+a*r.way[h]),l=s.rolling?Jr(n,t,!1):n;return bn(l,t,{spin:[c[0],c[1],Hn(s)[2]]})}var yp=n=>n.restitution?.form==="constant"?n.restitution.value??1:null,vp=(n,t)=>n.walls[Math.max(t,0)];function Bx(n,t,e){let i=vp(n,e);if(!i)return null;let s=n.balls[t].radius;if(i.shape==="table")return i.nose_height===null||i.nose_height===void 0?s:i.nose_height;if(i.shape!=="plane"||!n.floor)return null;let r=vn(i.normal);return Math.hypot(r[0],r[1])>.05?s*(1-r[2]):null}function kx(n,t,e,i){let s=n.balls[t].radius;return _p(n,e,r=>{if(r.shape==="table")return{...r,nose_height:i<=s*(1+1e-6)?null:i};if(r.shape!=="plane")return r;let o=vn(r.normal),a=Math.hypot(o[0],o[1]),c=Math.max(-.95,Math.min(.95,1-i/s)),l=Math.sqrt(1-c*c);return a>.05?{...r,normal:[o[0]/a*l,o[1]/a*l,c]}:r})}function zx(n,t,e){let i=n.balls[t],[s,r,o]=i.position,a=n.floor&&Math.abs(o-i.radius)<1e-9*i.radius;return bn(n,t,{radius:e,position:[s,r,a?e:Math.max(o,n.floor?e:o)]})}var Aa=n=>({read:(t,e,i)=>{let s=vp(t,i);return s?n==="restitution"?s.restitution?yp(s):1:hs(s[n]):null},write:(t,e,i,s)=>_p(t,i,r=>({...r,[n]:n==="restitution"?{form:"constant",value:s}:gp(s)}))}),Ea=n=>({read:({floor:t})=>t?n==="restitution"?yp(t):hs(t[n]):null,write:(t,e,i,s)=>t.floor?{...t,floor:{...t.floor,[n]:n==="restitution"?{form:"constant",value:s}:gp(s)}}:t}),bp=[{key:"speed",group:"Ball",label:"Speed",unit:"m/s",scale:1,least:0,most:8,step:.01,help:"along the floor",read:(n,t)=>Math.hypot(n.balls[t].velocity[0],n.balls[t].velocity[1]),write:(n,t,e,i)=>pp(n,t,i,dp(n,t))},{key:"angle",group:"Ball",label:"Angle",unit:"\xB0",scale:1,least:-180,most:180,step:.1,help:"from the wall's normal; without a plane wall from the x axis",read:dp,write:(n,t,e,i)=>pp(n,t,Math.hypot(n.balls[t].velocity[0],n.balls[t].velocity[1]),i)},{key:"topspin",group:"Ball",label:"Top / back spin",unit:"rad/s",scale:1,least:-200,most:200,step:.1,help:"positive as in rolling forward, negative: backspin; moving it ends rolling",read:(n,t)=>Ca(n.balls[t],"top"),write:(n,t,e,i)=>mp(n,t,"top",i)},{key:"sidespin",group:"Ball",label:"Side spin",unit:"rad/s",scale:1,least:-200,most:200,step:.1,help:"about the vertical, counterclockwise as seen from above",read:(n,t)=>Hn(n.balls[t])[2],write:(n,t,e,i)=>{let s=n.balls[t],[r,o]=Hn(s);return bn(n,t,s.rolling?{spin_z:i}:{spin:[r,o,i]})}},{key:"massespin",group:"Ball",label:"Mass\xE9 spin",unit:"rad/s",scale:1,least:-200,most:200,step:.1,help:"about the direction of motion, as after a mass\xE9; moving it ends rolling",read:(n,t)=>Ca(n.balls[t],"way"),write:(n,t,e,i)=>mp(n,t,"way",i)},{key:"height",group:"Ball",label:"Height",unit:"mm",scale:1e3,least:0,most:1,step:.001,help:"of its lowest point above the floor",read:(n,t)=>n.floor?Math.max(0,n.balls[t].position[2]-n.balls[t].radius):null,write:(n,t,e,i)=>{let s=i>0&&n.balls[t].rolling?Jr(n,t,!1):n,{position:r,radius:o}=s.balls[t];return bn(s,t,{position:[r[0],r[1],o+Math.max(0,i)]})}},{key:"rise",group:"Ball",label:"Upward speed",unit:"m/s",scale:1,least:-5,most:5,step:.01,read:(n,t)=>n.balls[t].velocity[2],write:(n,t,e,i)=>{let s=i!==0&&n.balls[t].rolling?Jr(n,t,!1):n,[r,o]=s.balls[t].velocity;return bn(s,t,{velocity:[r,o,i]})}},{key:"radius",group:"Ball",label:"Radius",unit:"mm",scale:1e3,least:.005,most:.08,step:25e-5,read:(n,t)=>n.balls[t].radius,write:(n,t,e,i)=>zx(n,t,i)},{key:"inertia",group:"Ball",label:"Inertia I/(m a\xB2)",unit:"",scale:1,least:.01,most:.66,step:.01,help:"0.4: solid ball; 0.667: thin shell",read:(n,t)=>ks(n.balls[t]),write:(n,t,e,i)=>bn(n,t,{inertia:Math.abs(i-2/3)<.001?2/3:i})},{key:"restitution",group:"Wall",label:"Restitution",unit:"",scale:1,least:0,most:1,step:.01,...Aa("restitution")},{key:"friction",group:"Wall",label:"Friction",unit:"",scale:1,least:0,most:1.5,step:.01,infinite:!0,help:"\u221E: never slips",...Aa("friction")},{key:"tangential_restitution",group:"Wall",label:"Tangential restitution",unit:"",scale:1,least:-1,most:1,step:.01,help:"0 stops the slip, 1 reverses it; maw and stronge compute it from the stiffness ratio",...Aa("tangential_restitution")},{key:"cushion_height",group:"Wall",label:"Cushion height",unit:"mm",scale:1e3,least:.01,most:.06,step:1e-4,help:"of the point where the wall touches the ball; at the ball's centre: an upright wall",read:Bx,write:kx},{key:"stiffness_ratio",group:"Wall",label:"Stiffness ratio",unit:"",scale:1,least:.2,most:2,step:.01,help:"tangential over normal, of the laws maw and stronge",...Aa("stiffness_ratio")},{key:"floor_restitution",group:"Floor",label:"Restitution",unit:"",scale:1,least:0,most:.95,step:.01,...Ea("restitution")},{key:"floor_friction",group:"Floor",label:"Friction",unit:"",scale:1,least:0,most:1.5,step:.01,infinite:!0,help:"\u221E: never slips",...Ea("friction")},{key:"rolling_resistance",group:"Floor",label:"Rolling resistance",unit:"",scale:1,least:0,most:.05,step:5e-4,...Ea("rolling_resistance")},{key:"spin_friction",group:"Floor",label:"Spin friction",unit:"",scale:1,least:0,most:.05,step:5e-4,...Ea("spin_friction")}];function Mp(n,t){let{key:e,label:i,unit:s,scale:r}=n,o={speed:[0,1e3],rise:[-1e3,1e3],height:[0,1e3],radius:[1e-4,1],inertia:[.001,2/3+1e-9],restitution:[0,1],floor_restitution:[0,1],friction:[0,1/0],floor_friction:[0,1/0],tangential_restitution:[-1,1],stiffness_ratio:[.001,1e3],rolling_resistance:[0,10],spin_friction:[0,10],angle:[-360,360],cushion_height:[1e-4,1]},[a,c]=o[e]??[-1e5,1e5];if(t>=a&&t<=c)return null;let l=h=>h===1/0?"\u221E":String(Number((h*r).toPrecision(4)));return`${i}: expected a number from ${l(a)} to ${l(c)}${s?` ${s}`:""}.`}var Sp={},Zh={},Jh=34,jr=10,jh=13;function Ap(n){return new Function("d","return {"+n.map(function(t,e){return JSON.stringify(t)+": d["+e+'] || ""'}).join(",")+"}")}function Vx(n,t){var e=Ap(n);return function(i,s){return t(e(i),s,n)}}function wp(n){var t=Object.create(null),e=[];return n.forEach(function(i){for(var s in i)s in t||e.push(t[s]=s)}),e}function nn(n,t){var e=n+"",i=e.length;return i<t?new Array(t-i+1).join(0)+e:e}function Gx(n){return n<0?"-"+nn(-n,6):n>9999?"+"+nn(n,6):nn(n,4)}function Hx(n){var t=n.getUTCHours(),e=n.getUTCMinutes(),i=n.getUTCSeconds(),s=n.getUTCMilliseconds();return isNaN(n)?"Invalid Date":Gx(n.getUTCFullYear(),4)+"-"+nn(n.getUTCMonth()+1,2)+"-"+nn(n.getUTCDate(),2)+(s?"T"+nn(t,2)+":"+nn(e,2)+":"+nn(i,2)+"."+nn(s,3)+"Z":i?"T"+nn(t,2)+":"+nn(e,2)+":"+nn(i,2)+"Z":e||t?"T"+nn(t,2)+":"+nn(e,2)+"Z":"")}function us(n){var t=new RegExp('["'+n+`
\r]`),e=n.charCodeAt(0);function i(u,f){var d,m,_=s(u,function(p,g){if(d)return d(p,g-1);m=p,d=f?Vx(p,f):Ap(p)});return _.columns=m||[],_}function s(u,f){var d=[],m=u.length,_=0,p=0,g,x=m<=0,b=!1;u.charCodeAt(m-1)===jr&&--m,u.charCodeAt(m-1)===jh&&--m;function v(){if(x)return Zh;if(b)return b=!1,Sp;var E,y=_,M;if(u.charCodeAt(y)===Jh){for(;_++<m&&u.charCodeAt(_)!==Jh||u.charCodeAt(++_)===Jh;);return(E=_)>=m?x=!0:(M=u.charCodeAt(_++))===jr?b=!0:M===jh&&(b=!0,u.charCodeAt(_)===jr&&++_),u.slice(y+1,E-1).replace(/""/g,'"')}for(;_<m;){if((M=u.charCodeAt(E=_++))===jr)b=!0;else if(M===jh)b=!0,u.charCodeAt(_)===jr&&++_;else if(M!==e)continue;return u.slice(y,E)}return x=!0,u.slice(y,m)}for(;(g=v())!==Zh;){for(var w=[];g!==Sp&&g!==Zh;)w.push(g),g=v();f&&(w=f(w,p++))==null||d.push(w)}return d}function r(u,f){return u.map(function(d){return f.map(function(m){return h(d[m])}).join(n)})}function o(u,f){return f==null&&(f=wp(u)),[f.map(h).join(n)].concat(r(u,f)).join(`
`)}function a(u,f){return f==null&&(f=wp(u)),r(u,f).join(`
`)}function c(u){return u.map(l).join(`
`)}function l(u){return u.map(h).join(n)}function h(u){return u==null?"":u instanceof Date?Hx(u):t.test(u+="")?'"'+u.replace(/"/g,'""')+'"':u}return{parse:i,parseRows:s,format:o,formatBody:a,formatRows:c,formatRow:l,formatValue:h}}var fs=us(","),Wx=fs.parse,Kh=fs.parseRows,Xx=fs.format,$x=fs.formatBody,Qh=fs.formatRows,qx=fs.formatRow,Yx=fs.formatValue;var ds=us("	"),Zx=ds.parse,tu=ds.parseRows,Jx=ds.format,jx=ds.formatBody,Kx=ds.formatRows,Qx=ds.formatRow,ty=ds.formatValue;var ry=/^[a-z0-9-_]+$/i,Ep=!!"".isWellFormed;function Qr(n){let t=typeof n;if(t==="object"){if(Array.isArray(n))return"array";if(typeof n.getUTCDate=="function"&&n instanceof Date)return"date";if(globalThis.Temporal){if(n.until){if(n instanceof Temporal.ZonedDateTime)return"temporal/tz+uc";if(n instanceof Temporal.PlainDateTime||n instanceof Temporal.PlainDate)return"temporal/uc";if(n instanceof Temporal.PlainTime||n instanceof Temporal.Instant)return"temporal";if(n instanceof Temporal.PlainYearMonth)return"temporal/x"}else if(n.toPlainDate&&n instanceof Temporal.PlainMonthDay||n.negated&&n instanceof Temporal.Duration)return"temporal/x"}}return t}function oy(n){for(let t=0;t<n.length;t++)if(Qr(n[t])!=="object")return!1;return n.length!=0}function Tp(n){return JSON.stringify(n).replaceAll("\x7F","\\u007f")}function ay(n){return Tp(Ep?n.toWellFormed():n)}function Cp(n){if(ry.test(n))return n;if(Ep&&!n.isWellFormed())throw new RangeError("key contains illegal lone surrogates");return Tp(n)}function eu(n,t,e,i,s){if(e===0)throw new Error("Could not stringify the object: maximum object depth exceeded");switch(t){case"number":if(isNaN(n))return"nan";if(n===1/0)return"inf";if(n===-1/0)return"-inf";if(Number.isInteger(n)&&(i||!Number.isSafeInteger(n)))return n.toFixed(1);case"bigint":case"boolean":case"temporal":return n.toString();case"string":return ay(n);case"date":if(isNaN(n.getTime()))throw new TypeError("cannot serialize invalid date");return n.toISOString();case"object":return ly(n,e,i,s);case"array":return cy(n,e,i,s);case"temporal/tz+uc":if(s){let r=n.timeZoneId,o=r.charCodeAt(0);if(o!==43&&o!==45&&(o!==85&&o!==71&&o!==90&&o!==69||r!=="UTC"&&r!=="UCT"&&r!=="Universal"&&r!=="Zulu"&&!r.startsWith("GMT")&&r!=="Greenwich"&&!r.startsWith("Etc/")))throw new TypeError("Temporal objects with an IANA timezone are not allowed in Temporal strict mode")}case"temporal/uc":if(s&&n.calendarId!=="iso8601")throw new TypeError("Temporal objects with a non-default calendar are not allowed in Temporal strict mode");return n.toString({calendarName:"never",timeZoneName:"never"});case"temporal/x":throw new TypeError("Unsupported "+n[Symbol.toStringTag])}}function ly(n,t,e,i){let s=Object.keys(n);if(s.length===0)return"{}";let r="{ ";for(let o=0;o<s.length;o++){let a=s[o];o&&(r+=", "),r+=Cp(a)+" = "+eu(n[a],Qr(n[a]),t-1,e,i)}return r+" }"}function cy(n,t,e,i){if(n.length===0)return"[]";let s="[ ";for(let r=0;r<n.length;r++){if(r&&(s+=", "),n[r]===null||n[r]===void 0)throw new TypeError("arrays cannot contain null or undefined values");s+=eu(n[r],Qr(n[r]),t-1,e,i)}return s+" ]"}function hy(n,t,e,i,s){if(e===0)throw new Error("Could not stringify the object: maximum object depth exceeded");let r="";for(let o=0;o<n.length;o++)r+=`${r&&`
`}[[${t}]]
`,r+=nu(0,n[o],t,e,i,s);return r}function nu(n,t,e,i,s,r){if(i===0)throw new Error("Could not stringify the object: maximum object depth exceeded");let o="",a="",c=Object.keys(t);for(let l=0;l<c.length;l++){let h=c[l];if(t[h]!==null&&t[h]!==void 0){let u=Qr(t[h]);if(u==="symbol"||u==="function")throw new TypeError(`cannot serialize values of type '${u}'`);let f=Cp(h);if(u==="array"&&oy(t[h]))a+=(a&&`
`)+hy(t[h],e?`${e}.${f}`:f,i-1,s,r);else if(u==="object"){let d=e?`${e}.${f}`:f;a+=(a&&`
`)+nu(d,t[h],d,i-1,s,r)}else o+=f,o+=" = ",o+=eu(t[h],u,i,s,r),o+=`
`}}return n&&(o||!a)&&(o=o?`[${n}]
${o}`:`[${n}]`),o&&a?`${o}
${a}`:o||a}function iu(n,{maxDepth:t=1e3,numbersAsFloat:e=!1,strictTemporal:i=!1}={}){if(Qr(n)!=="object")throw new TypeError("stringify can only be called with an object");let s=nu(0,n,"",t,e,i);return s[s.length-1]!==`
`?s+`
`:s}function ru(n){if(n==="inf")return 1/0;if(n==="-inf")return-1/0;if(Array.isArray(n))return n.map(ru);if(n&&typeof n=="object"){let t=n;return t.form==="constant"&&"value"in t?t.value:Object.fromEntries(Object.entries(n).filter(([,e])=>e!=null).map(([e,i])=>[e,ru(i)]))}return n}function Ip(n){let t=n.balls.map(({spin:s,spin_z:r,rolling:o,...a})=>({...a,rolling:o,...o?{spin_z:r}:{spin:s}})),e=n.walls.map(s=>({...s,preset:null})),i=ru({...n,walls:e,balls:t});return`# A scene of carom: carom simulate FILE, carom explore FILE. SI units.
${iu(i,{numbersAsFloat:!1})}`}var Rp=["x","y","z"];function Lp(n,t){let e=(r,o="")=>Rp.map(a=>`${r}${a}${o}`),i=["t","kind","ball","name","other","phase",...Rp,...e("v","_before"),...e("w","_before"),...e("v"),...e("w"),"required_friction"],s=t.events.map(r=>[r.t,r.kind,r.ball,n.balls[r.ball].name??`ball ${r.ball}`,r.other??-1,r.phase,...r.x,...r.v_before??[],...r.w_before??[],...r.v,...r.w,r.required??""]);return Qh([i,...s].map(r=>r.map(String)))}var ii=(n,t)=>(n.balls[t]?.name??String(t)).replace(/^\d+$/,"ball $&"),Ia=(n,t)=>n.walls[t]?.name??`${n.walls[t]?.shape??"wall"} ${t}`;function uy(n){return n.walls.flatMap(t=>os(t).map(({name:e})=>e))}var fy={wall:"meets",ball:"meets",floor:"lands",rolling:"rolls",sliding:"slides",pivoting:"spins on the spot",rest:"comes to rest",settled:"bounces no more",left:"clears",held:"is held",pocketed:"falls into the",flight:"flies",bouncing:"bounces",start:"starts"};function Np(n,t){let e=t.other??0,s={ball:()=>ii(n,e),wall:()=>Ia(n,e),left:()=>Ia(n,e),pocketed:()=>uy(n)[e]}[t.kind]?.()??"";return`${ii(n,t.ball)} ${fy[t.kind]??t.kind} ${s}`.trim()}var dy=5e6,Pp=2e4,su={m_s:1,cm_s:.01,mm_s:.001,km_h:1/3.6,ft_s:.3048,in_s:.0254,mph:.44704},Pa=["v_n_in","v_t_in","v_n_out","v_t_out"];function py(n){let t=n.trim().toLowerCase(),e=/^(.*?)\s*[[(]([^\])]*)[\])]$/.exec(t),i=(e?e[1]:t).trim().replaceAll(" ","_").replace(/^v([nt])_/,"v_$1_").replace(/_derived$/,"");for(let s of Pa){if(e&&i===s){let r=su[e[2].trim().replace("/","_")];if(r===void 0)throw new Error(`Column ${JSON.stringify(n)}: expected a unit of speed, such as m/s or mm/s.`);return{name:s,factor:r}}if(i===s)return{name:s,factor:1};if(i.startsWith(`${s}_`)&&su[i.slice(s.length+1)]!==void 0)return{name:s,factor:su[i.slice(s.length+1)]}}return null}function Dp(n){if(n.length>dy)throw new Error("This file is too large for the page: expected at most 5 MB.");if(n.includes("\0"))throw new Error("This file holds no text: expected a CSV table of rebounds.");let t=n.slice(0,n.search(/\r?\n|$/)),e=!t.includes(",")&&t.includes(";"),s=(e?l=>us(";").parseRows(l):t.includes("	")&&!t.includes(",")?tu:Kh)(n.replace(/^\uFEFF/,"")).filter(l=>l.some(h=>h.trim()));if(s.length<2)throw new Error("Expected a table of rebounds with a header and at least one row.");if(s.length>Pp)throw new Error(`Expected at most ${Pp} rows, got ${s.length-1}; carom fit takes more.`);let r=new Map,o=-1;s[0].forEach((l,h)=>{l.trim().toLowerCase()==="stage"&&(o=h);let u=py(l);u&&r.set(u.name,{at:h,factor:u.factor})});let a=Pa.filter(l=>!r.has(l));if(a.length)throw new Error(`Expected a table of rebounds, with the columns ${Pa.join(", ")}; this one lacks ${a.join(", ")}.`);let c=[];if(s.slice(1).forEach((l,h)=>{let[u,f,d,m]=Pa.map(x=>{let{at:b,factor:v}=r.get(x),w=(l[b]??"").trim();if(!w)return NaN;let E=Number(e?w.replace(",","."):w);if(!Number.isFinite(E))throw new Error(`Row ${h+1}, ${x}: expected a number, got ${JSON.stringify(w.slice(0,30))}.`);return E*v}),_=f<0?-1:1,p=Math.atan2(_*f,u)*180/Math.PI,g=Math.atan2(_*m,d)*180/Math.PI;Number.isFinite(p)&&Number.isFinite(g)&&c.push({incidence:p,reflection:g,stage:o<0?"":(l[o]??"").trim().slice(0,20)})}),!c.length)throw new Error("Expected rows with all four speeds, got none.");return c}function my(n){return n===1/0?"\u221E":Math.abs(n)<1e-9?"0":String(Number(n.toPrecision(4)))}function Up(n,t,e,i,s){let r=!1,o=[],a=Kt("select",{id:"ball-choice","aria-label":"Ball",change:()=>t.change({ball:Number(a.value)},"scene","laws")}),c=Kt("p",{class:"note",id:"strike",hidden:!0}),l=Kt("select",{id:"wall-choice","aria-label":"Wall",change:()=>t.change({wall:Number(l.value)},"scene")}),h=Kt("input",{type:"checkbox",id:"rolling",change:()=>{t.remember(),e(Jr(t.state.scene,t.state.ball,h.checked))}}),u=(_,p)=>p===1/0?_.most+_.step*4:Math.max(_.least,Math.min(_.most,p));for(let _ of["Ball","Wall","Floor"]){let p=Kt("section",{class:"controls","aria-label":_}),g=Kt("div",{class:"head"},Kt("h2",{},_));_==="Ball"&&g.append(a,Kt("label",{class:"check"},h,"rolling")),_==="Wall"&&g.append(l),p.append(g),_==="Ball"&&p.append(c);for(let x of bp.filter(b=>b.group===_)){let b=`control-${x.key}`,v=Kt("input",{type:"range",id:b,min:String(x.least),max:String(x.infinite?x.most+x.step*4:x.most),step:"any",change:()=>r=!1,input:()=>{r||t.remember(),r=!0;let y=Number(v.value),M=x.infinite&&y>x.most+x.step?1/0:Math.round(y/x.step)*x.step;f(x,M)}}),w=Kt("input",{type:"text",inputmode:"decimal",autocomplete:"off","aria-label":`${x.label}${x.unit?`, ${x.unit}`:""}`,id:`${b}-number`,change:()=>{let y=w.value.trim().replace("\u2212","-").replace(",","."),M=/^(inf|∞)$/i.test(y)?1/0:y===""?NaN:Number(y)/x.scale,L=Mp(x,M);if(L){i(L),m();return}t.remember(),f(x,M)}}),E=Kt("div",{class:"row",...x.help?{title:x.help}:{}},Kt("label",{for:b},x.label),v,w,Kt("span",{class:"unit"},x.unit));p.append(E),o.push({control:x,row:E,range:v,field:w})}n.append(p)}function f(_,p){let{scene:g,ball:x,wall:b}=t.state;e(_.write(g,x,b,p===1/0?p:Number(p.toPrecision(12))))}function d(_,p,g,x){let b=p.join(`
`);_.dataset.names!==b&&(_.replaceChildren(...p.map((v,w)=>Kt("option",{value:String(w+g)},v))),_.dataset.names=b),_.value=String(x),_.hidden=p.length<2}function m(){let{scene:_,ball:p,wall:g}=t.state;d(a,_.balls.map((x,b)=>ii(_,b)),0,p),d(l,_.walls.length>1?["all walls",..._.walls.map((x,b)=>Ia(_,b))]:["wall"],-1,g),c.textContent=s(_,p),c.hidden=!c.textContent,h.checked=_.balls[p].rolling,h.disabled=!_.floor;for(let{control:x,row:b,range:v,field:w}of o){let E=x.read(_,p,g);if(b.hidden=E===null,E===null)continue;if(x.key==="angle"){let M=Ra(_)?89.9:180;v.min=String(-M),v.max=String(M)}let y=my(E*x.scale);document.activeElement!==v&&(v.value=String(u(x,E))),v.setAttribute("aria-valuetext",`${y} ${x.unit}`.trim()),(document.activeElement!==w||w.dataset.said===w.value)&&(w.value=w.dataset.said=y)}for(let x of n.querySelectorAll("section"))x.hidden=[...x.querySelectorAll(".row")].every(b=>b.hidden)}return{update:m}}function gy(n,t){let e=document.createElementNS("http://www.w3.org/2000/svg","svg");e.setAttribute("viewBox","0 0 26 8"),e.setAttribute("class","sample"),e.setAttribute("aria-hidden","true");let i=document.createElementNS("http://www.w3.org/2000/svg","path");return i.setAttribute("d","M1 4H25"),i.setAttribute("stroke",n),i.setAttribute("stroke-width","3"),t&&i.setAttribute("stroke-dasharray",t.map(s=>s*2).join(" ")),e.append(i),e}function Op(n,t){let e=Kt("p",{class:"contact",hidden:!0});n.append(e);let i=t.state.cards.map(s=>{let r=Kt("input",{type:"checkbox",id:`law-${s.name}`,"aria-label":`show ${s.name}`,change:()=>{let{laws:f,followed:d}=t.state,m=t.state.cards.map(({name:_})=>_).filter(_=>_===s.name?r.checked:f.includes(_));t.change({laws:m,followed:m.includes(d)?d:m[0]??""},"laws")}}),o=Kt("button",{type:"button",class:"follow",title:`${s.summary} Press to follow its balls.`,click:()=>{let f=t.state.laws.includes(s.name)?t.state.laws:t.state.cards.map(({name:d})=>d).filter(d=>d===s.name||t.state.laws.includes(d));t.change({followed:s.name,laws:f},"laws")}},s.name),a=Kt("span",{class:"swatch"}),c=Kt("ul",{class:"why",hidden:!0,id:`why-${s.name}`}),l=Kt("button",{type:"button",class:"verdict","aria-controls":c.id,"aria-expanded":"false",click:()=>{c.hidden=!c.hidden,l.setAttribute("aria-expanded",String(!c.hidden))}}),h=Kt("dl",{}),u=Kt("article",{class:"law","data-law":s.name},Kt("header",{},r,a,o,l),c,h);return n.append(u),{card:s,box:r,follow:o,swatch:a,verdict:l,numbers:h,why:c,root:u}});return{update(s,r,o,a){e.textContent=a,e.hidden=!a;for(let{card:c,box:l,follow:h,swatch:u,verdict:f,numbers:d,why:m,root:_}of i){let p=s.get(c.name),g=o.get(c.name),x=r.get(c.name)??"currentColor",b=t.state.laws.includes(c.name);l.checked=b,_.style.setProperty("--law",x),_.classList.toggle("off",!b),_.classList.toggle("followed",t.state.followed===c.name),h.setAttribute("aria-pressed",String(t.state.followed===c.name)),u.replaceChildren(gy(x,c.dashes));let v=g?[g]:p?.reasons??[],w=p?.admissible&&!g;f.textContent=p||g?w?"\u2713 may apply":"\u2717 may not apply":"",f.className=`verdict ${w?"yes":"no"}`,f.disabled=v.length===0,f.title=v.join("; "),m.replaceChildren(...v.map(E=>Kt("li",{},E))),d.replaceChildren(...p?_y(p):[])}}}}function _y({angle:n,velocity:t,spin:e,energy_kept:i,hop:s,required:r,available:o}){return[["angle","angle",n===null?"\u2013":`${n.toFixed(1)}\xB0`],["energy","energy kept",i===null?"\u2013":`${(100*i).toFixed(1)} %`],["hop","hop",s===null?"\u2013":`${Ge(s*1e3)} mm`],["friction","\u03BC needed",r===null?"\u2013":`${Ge(r,2)} of ${Ge(o,2)}`],["velocity","velocity",t?`${t.map(c=>Ge(c)).join(", ")} m/s`:"\u2013"],["spin","spin",e?`${e.map(c=>Ge(c)).join(", ")} rad/s`:"\u2013"]].map(([c,l,h])=>Kt("div",{class:c},Kt("dt",{},l),Kt("dd",{},h)))}var xy=2e3,yy=600,Ni="as in the scene",si=n=>n instanceof Error?n.message:String(n);function zs(n,t){let e=n.faults(t);if(e.length)throw new Error(e.slice(0,3).join(". ")+(e.length>3?`. (${e.length-3} more)`:""));return t}function Vs(n,t,e){let i={runs:new Map,notes:new Map,fault:null};for(let s of e)try{let r=n.run(t,s===Ni?void 0:s,{events:xy,milliseconds:yy/e.length});i.runs.set(s,r);let o=`after ${r.events.length} events, at ${Number(r.until.toPrecision(4))} s`;r.status==="refused"&&i.notes.set(s,r.why),!(r.events.length>=(t.run.max_events??1/0))&&(r.status==="limit"||r.status==="time")&&i.notes.set(s,`The run is cut off ${o}: carom simulate goes on.`)}catch(r){i.notes.set(s,si(r))}return e.length&&!i.runs.size&&(i.fault=[...i.notes.values()][0]),i}function ou(n,t,e){try{let i=n.meeting(t),s=n.compareAt(i,e.map(({name:r})=>r));return{meeting:i,verdicts:new Map(s.map(r=>[r.law,r])),note:vy(t,i)}}catch(i){return{meeting:null,verdicts:new Map,note:si(i)}}}function vy(n,{t,balls:e}){return e===0?"":`The laws are compared at the first wall that ${ii(n,0)} meets: at ${t.toFixed(3)} s of the scene's own run, after ${Hh(e)}.`}var Fp=Array.from({length:30},(n,t)=>1+3*t);function Bp(n,t,e){let i=new Map;if(t===null)return i;for(let s of e)if(s!==Ni)try{i.set(s,n.curveAt(s,t,Fp).map((r,o)=>[Fp[o],r??NaN]))}catch{}return i}function au(n,t,e){if(e)return{from:e[0],until:e[1]};let i=0;for(let r of t){let o=r.events.at(-1)?.t??0,a=r.final.every(({phase:l})=>l==="rest"||l==="pocketed"),c=r.status==="done"||r.status==="quiet";i=Math.max(i,a||!c?o:o*1.3+.3)}let s=n.run.duration;return{from:0,until:Math.max(1e-6,s===null?i||1:Math.min(i||s,s))}}function lu(n,t){let e=[];for(let i of t?.events??[])i.kind==="start"||i.kind==="ball"&&(i.other??0)<i.ball||e.push({t:i.t,text:Np(n,i)});return e}function kp(n,t){let e=n.filter(({name:s})=>s!==Ni);return t.walls.some(s=>s.law!==null&&s.law!==void 0)?[{name:Ni,summary:"Each wall with its own law.",valid:"",colour:"#777777",dashes:null,reads:null},...e]:e}var by=6e4;function zp({scene:n,laws:t,followed:e,t:i},s){let r=new TextEncoder().encode(JSON.stringify({scene:n,laws:t,followed:e,t:Number(i.toPrecision(9))})),o="";for(let a of r)o+=String.fromCharCode(a);return`#${s?`preset=${encodeURIComponent(s)}&`:""}s=${btoa(o).replaceAll("+","-").replaceAll("/","_").replace(/=+$/,"")}`}function cu(n,t,e){let i=new URLSearchParams(n.replace(/^#/,"")).get("s");if(i===null)return null;if(i.length>by)throw new Error("This link is too long to be one of the explorer's.");let s;try{let l=atob(i.replaceAll("-","+").replaceAll("_","/"));s=JSON.parse(new TextDecoder("utf-8",{fatal:!0}).decode(Uint8Array.from(l,h=>h.charCodeAt(0))))}catch{throw new Error("This link is damaged: it may have been cut off when it was copied.")}if(typeof s!="object"||s===null)throw new Error("This link holds no scene.");let r=zs(t,s.scene),o=Array.isArray(s.laws)?e.filter(l=>s.laws.includes(l)):e,a=e.includes(s.followed)?s.followed:"",c=typeof s.t=="number"&&s.t>=0&&s.t<1e6?s.t:0;return{scene:r,laws:o,followed:a,t:c}}function hu(n,t){let e=URL.createObjectURL(t),i=Kt("a",{href:e,download:n});document.body.append(i),i.click(),i.remove(),setTimeout(()=>URL.revokeObjectURL(e),1e4)}function Vp(n,t,e,i){let s=()=>{let{scene:l,laws:h,followed:u,t:f,shot:d}=n.state;return zp({scene:l,laws:h,followed:u,t:f},d)},r=0;n.listen(l=>{document.documentElement.dataset.recorded||n.state.playing||l.size===1&&l.has("data")||(clearTimeout(r),r=window.setTimeout(()=>{try{history.replaceState(null,"",s())}catch{}},250))}),$t("link").onclick=async()=>{let l=location.href.split("#")[0]+s();if(location.protocol==="about:"){i("A notebook's frame has no address: save the scene instead, or write the page with carom explore --out.");return}try{history.replaceState(null,"",s()),await navigator.clipboard.writeText(l),i("The link is copied.",!0)}catch{i("The link is in the address bar.",!0)}};let o=()=>document.querySelector("details.menu").removeAttribute("open");$t("save-scene").onclick=()=>{let{scene:l,followed:h}=n.state,u=l.walls.some(f=>f.law)||!h;hu("scene.toml",new Blob([Ip(u?l:{...l,run:{...l.run,law:h}})],{type:"application/toml"})),o()},$t("save-events").onclick=()=>{let l=e();l?hu("events.csv",new Blob([Lp(n.state.scene,l)],{type:"text/csv"})):i("No law is shown: switch one on to save its events."),o()},$t("save-picture").onclick=async()=>{o();try{hu("scene.png",await t.picture())}catch(l){i(si(l))}};async function a(l){if(/\.toml$/i.test(l.name)){i("A scene is opened by carom explore FILE; here a table of measured rebounds (CSV) can be dropped.");return}try{if(l.size>2e7)throw new Error("This file is too large for the page: expected at most 5 MB.");let h=Dp(await l.text());n.change({rebounds:h,reboundsFrom:l.name},"data"),i(`${h.length} measured rebounds from ${l.name}.`,!0)}catch(h){i(`${l.name}: ${si(h)}`)}}addEventListener("dragover",l=>{l.preventDefault(),document.body.classList.add("dropping")}),addEventListener("dragleave",l=>{l.relatedTarget||document.body.classList.remove("dropping")}),addEventListener("drop",l=>{l.preventDefault(),document.body.classList.remove("dropping");let h=l.dataTransfer?.files[0];h&&a(h)});let c=$t("file");c.onchange=()=>{c.files?.[0]&&a(c.files[0]),c.value=""}}function La(n,t){return n==null||t==null?NaN:n<t?-1:n>t?1:n>=t?0:NaN}function My(n,t){return n==null||t==null?NaN:t<n?-1:t>n?1:t>=n?0:NaN}function Gp(n){let t,e,i;n.length!==2?(t=La,e=(a,c)=>La(n(a),c),i=(a,c)=>n(a)-c):(t=n===La||n===My?n:Sy,e=n,i=n);function s(a,c,l=0,h=a.length){if(l<h){if(t(c,c)!==0)return h;do{let u=l+h>>>1;e(a[u],c)<0?l=u+1:h=u}while(l<h)}return l}function r(a,c,l=0,h=a.length){if(l<h){if(t(c,c)!==0)return h;do{let u=l+h>>>1;e(a[u],c)<=0?l=u+1:h=u}while(l<h)}return l}function o(a,c,l=0,h=a.length){let u=s(a,c,l,h-1);return u>l&&i(a[u-1],c)>-i(a[u],c)?u-1:u}return{left:s,center:o,right:r}}function Sy(){return 0}function wy(n){return n===null?NaN:+n}var Hp=Gp(La),Wp=Hp.right,JC=Hp.left,jC=Gp(wy).center;var KC=Xp($p),QC=Xp(Ay);function Xp(n){return function(t,e,i=e){if(!((e=+e)>=0))throw new RangeError("invalid rx");if(!((i=+i)>=0))throw new RangeError("invalid ry");let{data:s,width:r,height:o}=t;if(!((r=Math.floor(r))>=0))throw new RangeError("invalid width");if(!((o=Math.floor(o!==void 0?o:s.length/r))>=0))throw new RangeError("invalid height");if(!r||!o||!e&&!i)return t;let a=e&&n(e),c=i&&n(i),l=s.slice();return a&&c?(Gs(a,l,s,r,o),Gs(a,s,l,r,o),Gs(a,l,s,r,o),Hs(c,s,l,r,o),Hs(c,l,s,r,o),Hs(c,s,l,r,o)):a?(Gs(a,s,l,r,o),Gs(a,l,s,r,o),Gs(a,s,l,r,o)):c&&(Hs(c,s,l,r,o),Hs(c,l,s,r,o),Hs(c,s,l,r,o)),t}}function Gs(n,t,e,i,s){for(let r=0,o=i*s;r<o;)n(t,e,r,r+=i,1)}function Hs(n,t,e,i,s){for(let r=0,o=i*s;r<i;++r)n(t,e,r,r+o,i)}function Ay(n){let t=$p(n);return(e,i,s,r,o)=>{s<<=2,r<<=2,o<<=2,t(e,i,s+0,r+0,o),t(e,i,s+1,r+1,o),t(e,i,s+2,r+2,o),t(e,i,s+3,r+3,o)}}function $p(n){let t=Math.floor(n);if(t===n)return Ey(n);let e=n-t,i=2*n+1;return(s,r,o,a,c)=>{if(!((a-=c)>=o))return;let l=t*r[o],h=c*t,u=h+c;for(let f=o,d=o+h;f<d;f+=c)l+=r[Math.min(a,f)];for(let f=o,d=a;f<=d;f+=c)l+=r[Math.min(a,f+h)],s[f]=(l+e*(r[Math.max(o,f-u)]+r[Math.min(a,f+u)]))/i,l-=r[Math.max(o,f-h)]}}function Ey(n){let t=2*n+1;return(e,i,s,r,o)=>{if(!((r-=o)>=s))return;let a=n*i[s],c=o*n;for(let l=s,h=s+c;l<h;l+=o)a+=i[Math.min(r,l)];for(let l=s,h=r;l<=h;l+=o)a+=i[Math.min(r,l+c)],e[l]=a/t,a-=i[Math.max(s,l-c)]}}var Ty=Array.prototype,tR=Ty.slice;var Cy=Math.sqrt(50),Ry=Math.sqrt(10),Py=Math.sqrt(2);function Na(n,t,e){let i=(t-n)/Math.max(0,e),s=Math.floor(Math.log10(i)),r=i/Math.pow(10,s),o=r>=Cy?10:r>=Ry?5:r>=Py?2:1,a,c,l;return s<0?(l=Math.pow(10,-s)/o,a=Math.round(n*l),c=Math.round(t*l),a/l<n&&++a,c/l>t&&--c,l=-l):(l=Math.pow(10,s)*o,a=Math.round(n/l),c=Math.round(t/l),a*l<n&&++a,c*l>t&&--c),c<a&&.5<=e&&e<2?Na(n,t,e*2):[a,c,l]}function qp(n,t,e){if(t=+t,n=+n,e=+e,!(e>0))return[];if(n===t)return[n];let i=t<n,[s,r,o]=i?Na(t,n,e):Na(n,t,e);if(!(r>=s))return[];let a=r-s+1,c=new Array(a);if(i)if(o<0)for(let l=0;l<a;++l)c[l]=(r-l)/-o;else for(let l=0;l<a;++l)c[l]=(r-l)*o;else if(o<0)for(let l=0;l<a;++l)c[l]=(s+l)/-o;else for(let l=0;l<a;++l)c[l]=(s+l)*o;return c}function Da(n,t,e){return t=+t,n=+n,e=+e,Na(n,t,e)[2]}function Yp(n,t,e){t=+t,n=+n,e=+e;let i=t<n,s=i?Da(t,n,e):Da(n,t,e);return(i?-1:1)*(s<0?1/-s:s)}var eR=Iy(Math.random);function Iy(n){return function(e,i=0,s=e.length){let r=s-(i=+i);for(;r;){let o=n()*r--|0,a=e[r+i];e[r+i]=e[o+i],e[o+i]=a}return e}}function Zp(n,t){switch(arguments.length){case 0:break;case 1:this.range(n);break;default:this.range(t).domain(n);break}return this}function qs(n,t,e){n.prototype=t.prototype=e,e.constructor=n}function no(n,t){var e=Object.create(n.prototype);for(var i in t)e[i]=t[i];return e}function Di(){}var _s=.7,$s=1/_s,Ws="\\s*([+-]?\\d+)\\s*",to="\\s*([+-]?(?:\\d*\\.)?\\d+(?:[eE][+-]?\\d+)?)\\s*",Wn="\\s*([+-]?(?:\\d*\\.)?\\d+(?:[eE][+-]?\\d+)?)%\\s*",Ly=/^#([0-9a-f]{3,8})$/,Ny=new RegExp(`^rgb\\(${Ws},${Ws},${Ws}\\)$`),Dy=new RegExp(`^rgb\\(${Wn},${Wn},${Wn}\\)$`),Uy=new RegExp(`^rgba\\(${Ws},${Ws},${Ws},${to}\\)$`),Oy=new RegExp(`^rgba\\(${Wn},${Wn},${Wn},${to}\\)$`),Fy=new RegExp(`^hsl\\(${to},${Wn},${Wn}\\)$`),By=new RegExp(`^hsla\\(${to},${Wn},${Wn},${to}\\)$`),Jp={aliceblue:15792383,antiquewhite:16444375,aqua:65535,aquamarine:8388564,azure:15794175,beige:16119260,bisque:16770244,black:0,blanchedalmond:16772045,blue:255,blueviolet:9055202,brown:10824234,burlywood:14596231,cadetblue:6266528,chartreuse:8388352,chocolate:13789470,coral:16744272,cornflowerblue:6591981,cornsilk:16775388,crimson:14423100,cyan:65535,darkblue:139,darkcyan:35723,darkgoldenrod:12092939,darkgray:11119017,darkgreen:25600,darkgrey:11119017,darkkhaki:12433259,darkmagenta:9109643,darkolivegreen:5597999,darkorange:16747520,darkorchid:10040012,darkred:9109504,darksalmon:15308410,darkseagreen:9419919,darkslateblue:4734347,darkslategray:3100495,darkslategrey:3100495,darkturquoise:52945,darkviolet:9699539,deeppink:16716947,deepskyblue:49151,dimgray:6908265,dimgrey:6908265,dodgerblue:2003199,firebrick:11674146,floralwhite:16775920,forestgreen:2263842,fuchsia:16711935,gainsboro:14474460,ghostwhite:16316671,gold:16766720,goldenrod:14329120,gray:8421504,green:32768,greenyellow:11403055,grey:8421504,honeydew:15794160,hotpink:16738740,indianred:13458524,indigo:4915330,ivory:16777200,khaki:15787660,lavender:15132410,lavenderblush:16773365,lawngreen:8190976,lemonchiffon:16775885,lightblue:11393254,lightcoral:15761536,lightcyan:14745599,lightgoldenrodyellow:16448210,lightgray:13882323,lightgreen:9498256,lightgrey:13882323,lightpink:16758465,lightsalmon:16752762,lightseagreen:2142890,lightskyblue:8900346,lightslategray:7833753,lightslategrey:7833753,lightsteelblue:11584734,lightyellow:16777184,lime:65280,limegreen:3329330,linen:16445670,magenta:16711935,maroon:8388608,mediumaquamarine:6737322,mediumblue:205,mediumorchid:12211667,mediumpurple:9662683,mediumseagreen:3978097,mediumslateblue:8087790,mediumspringgreen:64154,mediumturquoise:4772300,mediumvioletred:13047173,midnightblue:1644912,mintcream:16121850,mistyrose:16770273,moccasin:16770229,navajowhite:16768685,navy:128,oldlace:16643558,olive:8421376,olivedrab:7048739,orange:16753920,orangered:16729344,orchid:14315734,palegoldenrod:15657130,palegreen:10025880,paleturquoise:11529966,palevioletred:14381203,papayawhip:16773077,peachpuff:16767673,peru:13468991,pink:16761035,plum:14524637,powderblue:11591910,purple:8388736,rebeccapurple:6697881,red:16711680,rosybrown:12357519,royalblue:4286945,saddlebrown:9127187,salmon:16416882,sandybrown:16032864,seagreen:3050327,seashell:16774638,sienna:10506797,silver:12632256,skyblue:8900331,slateblue:6970061,slategray:7372944,slategrey:7372944,snow:16775930,springgreen:65407,steelblue:4620980,tan:13808780,teal:32896,thistle:14204888,tomato:16737095,turquoise:4251856,violet:15631086,wheat:16113331,white:16777215,whitesmoke:16119285,yellow:16776960,yellowgreen:10145074};qs(Di,Ys,{copy(n){return Object.assign(new this.constructor,this,n)},displayable(){return this.rgb().displayable()},hex:jp,formatHex:jp,formatHex8:ky,formatHsl:zy,formatRgb:Kp,toString:Kp});function jp(){return this.rgb().formatHex()}function ky(){return this.rgb().formatHex8()}function zy(){return am(this).formatHsl()}function Kp(){return this.rgb().formatRgb()}function Ys(n){var t,e;return n=(n+"").trim().toLowerCase(),(t=Ly.exec(n))?(e=t[1].length,t=parseInt(t[1],16),e===6?Qp(t):e===3?new Ce(t>>8&15|t>>4&240,t>>4&15|t&240,(t&15)<<4|t&15,1):e===8?Ua(t>>24&255,t>>16&255,t>>8&255,(t&255)/255):e===4?Ua(t>>12&15|t>>8&240,t>>8&15|t>>4&240,t>>4&15|t&240,((t&15)<<4|t&15)/255):null):(t=Ny.exec(n))?new Ce(t[1],t[2],t[3],1):(t=Dy.exec(n))?new Ce(t[1]*255/100,t[2]*255/100,t[3]*255/100,1):(t=Uy.exec(n))?Ua(t[1],t[2],t[3],t[4]):(t=Oy.exec(n))?Ua(t[1]*255/100,t[2]*255/100,t[3]*255/100,t[4]):(t=Fy.exec(n))?nm(t[1],t[2]/100,t[3]/100,1):(t=By.exec(n))?nm(t[1],t[2]/100,t[3]/100,t[4]):Jp.hasOwnProperty(n)?Qp(Jp[n]):n==="transparent"?new Ce(NaN,NaN,NaN,0):null}function Qp(n){return new Ce(n>>16&255,n>>8&255,n&255,1)}function Ua(n,t,e,i){return i<=0&&(n=t=e=NaN),new Ce(n,t,e,i)}function gu(n){return n instanceof Di||(n=Ys(n)),n?(n=n.rgb(),new Ce(n.r,n.g,n.b,n.opacity)):new Ce}function io(n,t,e,i){return arguments.length===1?gu(n):new Ce(n,t,e,i??1)}function Ce(n,t,e,i){this.r=+n,this.g=+t,this.b=+e,this.opacity=+i}qs(Ce,io,no(Di,{brighter(n){return n=n==null?$s:Math.pow($s,n),new Ce(this.r*n,this.g*n,this.b*n,this.opacity)},darker(n){return n=n==null?_s:Math.pow(_s,n),new Ce(this.r*n,this.g*n,this.b*n,this.opacity)},rgb(){return this},clamp(){return new Ce(ms(this.r),ms(this.g),ms(this.b),Fa(this.opacity))},displayable(){return-.5<=this.r&&this.r<255.5&&-.5<=this.g&&this.g<255.5&&-.5<=this.b&&this.b<255.5&&0<=this.opacity&&this.opacity<=1},hex:tm,formatHex:tm,formatHex8:Vy,formatRgb:em,toString:em}));function tm(){return`#${ps(this.r)}${ps(this.g)}${ps(this.b)}`}function Vy(){return`#${ps(this.r)}${ps(this.g)}${ps(this.b)}${ps((isNaN(this.opacity)?1:this.opacity)*255)}`}function em(){let n=Fa(this.opacity);return`${n===1?"rgb(":"rgba("}${ms(this.r)}, ${ms(this.g)}, ${ms(this.b)}${n===1?")":`, ${n})`}`}function Fa(n){return isNaN(n)?1:Math.max(0,Math.min(1,n))}function ms(n){return Math.max(0,Math.min(255,Math.round(n)||0))}function ps(n){return n=ms(n),(n<16?"0":"")+n.toString(16)}function nm(n,t,e,i){return i<=0?n=t=e=NaN:e<=0||e>=1?n=t=NaN:t<=0&&(n=NaN),new In(n,t,e,i)}function am(n){if(n instanceof In)return new In(n.h,n.s,n.l,n.opacity);if(n instanceof Di||(n=Ys(n)),!n)return new In;if(n instanceof In)return n;n=n.rgb();var t=n.r/255,e=n.g/255,i=n.b/255,s=Math.min(t,e,i),r=Math.max(t,e,i),o=NaN,a=r-s,c=(r+s)/2;return a?(t===r?o=(e-i)/a+(e<i)*6:e===r?o=(i-t)/a+2:o=(t-e)/a+4,a/=c<.5?r+s:2-r-s,o*=60):a=c>0&&c<1?0:o,new In(o,a,c,n.opacity)}function ka(n,t,e,i){return arguments.length===1?am(n):new In(n,t,e,i??1)}function In(n,t,e,i){this.h=+n,this.s=+t,this.l=+e,this.opacity=+i}qs(In,ka,no(Di,{brighter(n){return n=n==null?$s:Math.pow($s,n),new In(this.h,this.s,this.l*n,this.opacity)},darker(n){return n=n==null?_s:Math.pow(_s,n),new In(this.h,this.s,this.l*n,this.opacity)},rgb(){var n=this.h%360+(this.h<0)*360,t=isNaN(n)||isNaN(this.s)?0:this.s,e=this.l,i=e+(e<.5?e:1-e)*t,s=2*e-i;return new Ce(uu(n>=240?n-240:n+120,s,i),uu(n,s,i),uu(n<120?n+240:n-120,s,i),this.opacity)},clamp(){return new In(im(this.h),Oa(this.s),Oa(this.l),Fa(this.opacity))},displayable(){return(0<=this.s&&this.s<=1||isNaN(this.s))&&0<=this.l&&this.l<=1&&0<=this.opacity&&this.opacity<=1},formatHsl(){let n=Fa(this.opacity);return`${n===1?"hsl(":"hsla("}${im(this.h)}, ${Oa(this.s)*100}%, ${Oa(this.l)*100}%${n===1?")":`, ${n})`}`}}));function im(n){return n=(n||0)%360,n<0?n+360:n}function Oa(n){return Math.max(0,Math.min(1,n||0))}function uu(n,t,e){return(n<60?t+(e-t)*n/60:n<180?e:n<240?t+(e-t)*(240-n)/60:t)*255}var lm=Math.PI/180,cm=180/Math.PI,Ba=18,hm=.96422,um=1,fm=.82521,dm=4/29,Xs=6/29,pm=3*Xs*Xs,Gy=Xs*Xs*Xs;function mm(n){if(n instanceof Xn)return new Xn(n.l,n.a,n.b,n.opacity);if(n instanceof ri)return _m(n);n instanceof Ce||(n=gu(n));var t=mu(n.r),e=mu(n.g),i=mu(n.b),s=fu((.2225045*t+.7168786*e+.0606169*i)/um),r,o;return t===e&&e===i?r=o=s:(r=fu((.4360747*t+.3850649*e+.1430804*i)/hm),o=fu((.0139322*t+.0971045*e+.7141733*i)/fm)),new Xn(116*s-16,500*(r-s),200*(s-o),n.opacity)}function gm(n,t,e,i){return arguments.length===1?mm(n):new Xn(n,t,e,i??1)}function Xn(n,t,e,i){this.l=+n,this.a=+t,this.b=+e,this.opacity=+i}qs(Xn,gm,no(Di,{brighter(n){return new Xn(this.l+Ba*(n??1),this.a,this.b,this.opacity)},darker(n){return new Xn(this.l-Ba*(n??1),this.a,this.b,this.opacity)},rgb(){var n=(this.l+16)/116,t=isNaN(this.a)?n:n+this.a/500,e=isNaN(this.b)?n:n-this.b/200;return t=hm*du(t),n=um*du(n),e=fm*du(e),new Ce(pu(3.1338561*t-1.6168667*n-.4906146*e),pu(-.9787684*t+1.9161415*n+.033454*e),pu(.0719453*t-.2289914*n+1.4052427*e),this.opacity)}}));function fu(n){return n>Gy?Math.pow(n,1/3):n/pm+dm}function du(n){return n>Xs?n*n*n:pm*(n-dm)}function pu(n){return 255*(n<=.0031308?12.92*n:1.055*Math.pow(n,1/2.4)-.055)}function mu(n){return(n/=255)<=.04045?n/12.92:Math.pow((n+.055)/1.055,2.4)}function Hy(n){if(n instanceof ri)return new ri(n.h,n.c,n.l,n.opacity);if(n instanceof Xn||(n=mm(n)),n.a===0&&n.b===0)return new ri(NaN,0<n.l&&n.l<100?0:NaN,n.l,n.opacity);var t=Math.atan2(n.b,n.a)*cm;return new ri(t<0?t+360:t,Math.sqrt(n.a*n.a+n.b*n.b),n.l,n.opacity)}function za(n,t,e,i){return arguments.length===1?Hy(n):new ri(n,t,e,i??1)}function ri(n,t,e,i){this.h=+n,this.c=+t,this.l=+e,this.opacity=+i}function _m(n){if(isNaN(n.h))return new Xn(n.l,0,0,n.opacity);var t=n.h*lm;return new Xn(n.l,Math.cos(t)*n.c,Math.sin(t)*n.c,n.opacity)}qs(ri,za,no(Di,{brighter(n){return new ri(this.h,this.c,this.l+Ba*(n??1),this.opacity)},darker(n){return new ri(this.h,this.c,this.l-Ba*(n??1),this.opacity)},rgb(){return _m(this).rgb()}}));var xm=-.14861,_u=1.78277,xu=-.29227,Va=-.90649,eo=1.97294,sm=eo*Va,rm=eo*_u,om=_u*xu-Va*xm;function Wy(n){if(n instanceof gs)return new gs(n.h,n.s,n.l,n.opacity);n instanceof Ce||(n=gu(n));var t=n.r/255,e=n.g/255,i=n.b/255,s=(om*i+sm*t-rm*e)/(om+sm-rm),r=i-s,o=(eo*(e-s)-xu*r)/Va,a=Math.sqrt(o*o+r*r)/(eo*s*(1-s)),c=a?Math.atan2(o,r)*cm-120:NaN;return new gs(c<0?c+360:c,a,s,n.opacity)}function Ga(n,t,e,i){return arguments.length===1?Wy(n):new gs(n,t,e,i??1)}function gs(n,t,e,i){this.h=+n,this.s=+t,this.l=+e,this.opacity=+i}qs(gs,Ga,no(Di,{brighter(n){return n=n==null?$s:Math.pow($s,n),new gs(this.h,this.s,this.l*n,this.opacity)},darker(n){return n=n==null?_s:Math.pow(_s,n),new gs(this.h,this.s,this.l*n,this.opacity)},rgb(){var n=isNaN(this.h)?0:(this.h+120)*lm,t=+this.l,e=isNaN(this.s)?0:this.s*t*(1-t),i=Math.cos(n),s=Math.sin(n);return new Ce(255*(t+e*(xm*i+_u*s)),255*(t+e*(xu*i+Va*s)),255*(t+e*(eo*i)),this.opacity)}}));function Mm(n,t,e,i,s){var r=n*n,o=r*n;return((1-3*n+3*r-o)*t+(4-6*r+3*o)*e+(1+3*n+3*r-3*o)*i+o*s)/6}function Xy(n){var t=n.length-1;return function(e){var i=e<=0?e=0:e>=1?(e=1,t-1):Math.floor(e*t),s=n[i],r=n[i+1],o=i>0?n[i-1]:2*s-r,a=i<t-1?n[i+2]:2*r-s;return Mm((e-i/t)*t,o,s,r,a)}}function $y(n){var t=n.length;return function(e){var i=Math.floor(((e%=1)<0?++e:e)*t),s=n[(i+t-1)%t],r=n[i%t],o=n[(i+1)%t],a=n[(i+2)%t];return Mm((e-i/t)*t,s,r,o,a)}}var Wa=n=>()=>n;function Sm(n,t){return function(e){return n+e*t}}function qy(n,t,e){return n=Math.pow(n,e),t=Math.pow(t,e)-n,e=1/e,function(i){return Math.pow(n+i*t,e)}}function Mu(n,t){var e=t-n;return e?Sm(n,e>180||e<-180?e-360*Math.round(e/360):e):Wa(isNaN(n)?t:n)}function Yy(n){return(n=+n)==1?sn:function(t,e){return e-t?qy(t,e,n):Wa(isNaN(t)?e:t)}}function sn(n,t){var e=t-n;return e?Sm(n,e):Wa(isNaN(n)?t:n)}var ym=(function n(t){var e=Yy(t);function i(s,r){var o=e((s=io(s)).r,(r=io(r)).r),a=e(s.g,r.g),c=e(s.b,r.b),l=sn(s.opacity,r.opacity);return function(h){return s.r=o(h),s.g=a(h),s.b=c(h),s.opacity=l(h),s+""}}return i.gamma=n,i})(1);function wm(n){return function(t){var e=t.length,i=new Array(e),s=new Array(e),r=new Array(e),o,a;for(o=0;o<e;++o)a=io(t[o]),i[o]=a.r||0,s[o]=a.g||0,r[o]=a.b||0;return i=n(i),s=n(s),r=n(r),a.opacity=1,function(c){return a.r=i(c),a.g=s(c),a.b=r(c),a+""}}}var oR=wm(Xy),aR=wm($y);function Zy(n,t){t||(t=[]);var e=n?Math.min(t.length,n.length):0,i=t.slice(),s;return function(r){for(s=0;s<e;++s)i[s]=n[s]*(1-r)+t[s]*r;return i}}function Jy(n){return ArrayBuffer.isView(n)&&!(n instanceof DataView)}function jy(n,t){var e=t?t.length:0,i=n?Math.min(e,n.length):0,s=new Array(i),r=new Array(e),o;for(o=0;o<i;++o)s[o]=Xa(n[o],t[o]);for(;o<e;++o)r[o]=t[o];return function(a){for(o=0;o<i;++o)r[o]=s[o](a);return r}}function Ky(n,t){var e=new Date;return n=+n,t=+t,function(i){return e.setTime(n*(1-i)+t*i),e}}function Ln(n,t){return n=+n,t=+t,function(e){return n*(1-e)+t*e}}function Qy(n,t){var e={},i={},s;(n===null||typeof n!="object")&&(n={}),(t===null||typeof t!="object")&&(t={});for(s in t)s in n?e[s]=Xa(n[s],t[s]):i[s]=t[s];return function(r){for(s in e)i[s]=e[s](r);return i}}var vu=/[-+]?(?:\d+\.?\d*|\.?\d+)(?:[eE][-+]?\d+)?/g,yu=new RegExp(vu.source,"g");function tv(n){return function(){return n}}function ev(n){return function(t){return n(t)+""}}function nv(n,t){var e=vu.lastIndex=yu.lastIndex=0,i,s,r,o=-1,a=[],c=[];for(n=n+"",t=t+"";(i=vu.exec(n))&&(s=yu.exec(t));)(r=s.index)>e&&(r=t.slice(e,r),a[o]?a[o]+=r:a[++o]=r),(i=i[0])===(s=s[0])?a[o]?a[o]+=s:a[++o]=s:(a[++o]=null,c.push({i:o,x:Ln(i,s)})),e=yu.lastIndex;return e<t.length&&(r=t.slice(e),a[o]?a[o]+=r:a[++o]=r),a.length<2?c[0]?ev(c[0].x):tv(t):(t=c.length,function(l){for(var h=0,u;h<t;++h)a[(u=c[h]).i]=u.x(l);return a.join("")})}function Xa(n,t){var e=typeof t,i;return t==null||e==="boolean"?Wa(t):(e==="number"?Ln:e==="string"?(i=Ys(t))?(t=i,ym):nv:t instanceof Ys?ym:t instanceof Date?Ky:Jy(t)?Zy:Array.isArray(t)?jy:typeof t.valueOf!="function"&&typeof t.toString!="function"||isNaN(t)?Qy:Ln)(n,t)}function Am(n,t){return n=+n,t=+t,function(e){return Math.round(n*(1-e)+t*e)}}var vm=180/Math.PI,bu={translateX:0,translateY:0,rotate:0,skewX:0,scaleX:1,scaleY:1};function Em(n,t,e,i,s,r){var o,a,c;return(o=Math.sqrt(n*n+t*t))&&(n/=o,t/=o),(c=n*e+t*i)&&(e-=n*c,i-=t*c),(a=Math.sqrt(e*e+i*i))&&(e/=a,i/=a,c/=a),n*i<t*e&&(n=-n,t=-t,c=-c,o=-o),{translateX:s,translateY:r,rotate:Math.atan2(t,n)*vm,skewX:Math.atan(c)*vm,scaleX:o,scaleY:a}}var Ha;function iv(n){let t=new(typeof DOMMatrix=="function"?DOMMatrix:WebKitCSSMatrix)(n+"");return t.isIdentity?bu:Em(t.a,t.b,t.c,t.d,t.e,t.f)}function sv(n){return n==null||(Ha||(Ha=document.createElementNS("http://www.w3.org/2000/svg","g")),Ha.setAttribute("transform",n),!(n=Ha.transform.baseVal.consolidate()))?bu:(n=n.matrix,Em(n.a,n.b,n.c,n.d,n.e,n.f))}function Tm(n,t,e,i){function s(l){return l.length?l.pop()+" ":""}function r(l,h,u,f,d,m){if(l!==u||h!==f){var _=d.push("translate(",null,t,null,e);m.push({i:_-4,x:Ln(l,u)},{i:_-2,x:Ln(h,f)})}else(u||f)&&d.push("translate("+u+t+f+e)}function o(l,h,u,f){l!==h?(l-h>180?h+=360:h-l>180&&(l+=360),f.push({i:u.push(s(u)+"rotate(",null,i)-2,x:Ln(l,h)})):h&&u.push(s(u)+"rotate("+h+i)}function a(l,h,u,f){l!==h?f.push({i:u.push(s(u)+"skewX(",null,i)-2,x:Ln(l,h)}):h&&u.push(s(u)+"skewX("+h+i)}function c(l,h,u,f,d,m){if(l!==u||h!==f){var _=d.push(s(d)+"scale(",null,",",null,")");m.push({i:_-4,x:Ln(l,u)},{i:_-2,x:Ln(h,f)})}else(u!==1||f!==1)&&d.push(s(d)+"scale("+u+","+f+")")}return function(l,h){var u=[],f=[];return l=n(l),h=n(h),r(l.translateX,l.translateY,h.translateX,h.translateY,u,f),o(l.rotate,h.rotate,u,f),a(l.skewX,h.skewX,u,f),c(l.scaleX,l.scaleY,h.scaleX,h.scaleY,u,f),l=h=null,function(d){for(var m=-1,_=f.length,p;++m<_;)u[(p=f[m]).i]=p.x(d);return u.join("")}}}var lR=Tm(iv,"px, ","px)","deg)"),cR=Tm(sv,", ",")",")"),rv=1e-12;function bm(n){return((n=Math.exp(n))+1/n)/2}function ov(n){return((n=Math.exp(n))-1/n)/2}function av(n){return((n=Math.exp(2*n))-1)/(n+1)}var hR=(function n(t,e,i){function s(r,o){var a=r[0],c=r[1],l=r[2],h=o[0],u=o[1],f=o[2],d=h-a,m=u-c,_=d*d+m*m,p,g;if(_<rv)g=Math.log(f/l)/t,p=function(y){return[a+y*d,c+y*m,l*Math.exp(t*y*g)]};else{var x=Math.sqrt(_),b=(f*f-l*l+i*_)/(2*l*e*x),v=(f*f-l*l-i*_)/(2*f*e*x),w=Math.log(Math.sqrt(b*b+1)-b),E=Math.log(Math.sqrt(v*v+1)-v);g=(E-w)/t,p=function(y){var M=y*g,L=bm(w),R=l/(e*x)*(L*av(t*M+w)-ov(w));return[a+R*d,c+R*m,l*L/bm(t*M+w)]}}return p.duration=Math.abs(g)*1e3*t/Math.SQRT2,p}return s.rho=function(r){var o=Math.max(.001,+r),a=o*o,c=a*a;return n(o,a,c)},s})(Math.SQRT2,2,4);function Cm(n){return function(t,e){var i=n((t=ka(t)).h,(e=ka(e)).h),s=sn(t.s,e.s),r=sn(t.l,e.l),o=sn(t.opacity,e.opacity);return function(a){return t.h=i(a),t.s=s(a),t.l=r(a),t.opacity=o(a),t+""}}}var uR=Cm(Mu),fR=Cm(sn);function Rm(n){return function(t,e){var i=n((t=za(t)).h,(e=za(e)).h),s=sn(t.c,e.c),r=sn(t.l,e.l),o=sn(t.opacity,e.opacity);return function(a){return t.h=i(a),t.c=s(a),t.l=r(a),t.opacity=o(a),t+""}}}var dR=Rm(Mu),pR=Rm(sn);function Pm(n){return(function t(e){e=+e;function i(s,r){var o=n((s=Ga(s)).h,(r=Ga(r)).h),a=sn(s.s,r.s),c=sn(s.l,r.l),l=sn(s.opacity,r.opacity);return function(h){return s.h=o(h),s.s=a(h),s.l=c(Math.pow(h,e)),s.opacity=l(h),s+""}}return i.gamma=t,i})(1)}var mR=Pm(Mu),gR=Pm(sn);function Su(n){return function(){return n}}function wu(n){return+n}var Im=[0,1];function Zs(n){return n}function Au(n,t){return(t-=n=+n)?function(e){return(e-n)/t}:Su(isNaN(t)?NaN:.5)}function lv(n,t){var e;return n>t&&(e=n,n=t,t=e),function(i){return Math.max(n,Math.min(t,i))}}function cv(n,t,e){var i=n[0],s=n[1],r=t[0],o=t[1];return s<i?(i=Au(s,i),r=e(o,r)):(i=Au(i,s),r=e(r,o)),function(a){return r(i(a))}}function hv(n,t,e){var i=Math.min(n.length,t.length)-1,s=new Array(i),r=new Array(i),o=-1;for(n[i]<n[0]&&(n=n.slice().reverse(),t=t.slice().reverse());++o<i;)s[o]=Au(n[o],n[o+1]),r[o]=e(t[o],t[o+1]);return function(a){var c=Wp(n,a,1,i)-1;return r[c](s[c](a))}}function Lm(n,t){return t.domain(n.domain()).range(n.range()).interpolate(n.interpolate()).clamp(n.clamp()).unknown(n.unknown())}function uv(){var n=Im,t=Im,e=Xa,i,s,r,o=Zs,a,c,l;function h(){var f=Math.min(n.length,t.length);return o!==Zs&&(o=lv(n[0],n[f-1])),a=f>2?hv:cv,c=l=null,u}function u(f){return f==null||isNaN(f=+f)?r:(c||(c=a(n.map(i),t,e)))(i(o(f)))}return u.invert=function(f){return o(s((l||(l=a(t,n.map(i),Ln)))(f)))},u.domain=function(f){return arguments.length?(n=Array.from(f,wu),h()):n.slice()},u.range=function(f){return arguments.length?(t=Array.from(f),h()):t.slice()},u.rangeRound=function(f){return t=Array.from(f),e=Am,h()},u.clamp=function(f){return arguments.length?(o=f?!0:Zs,h()):o!==Zs},u.interpolate=function(f){return arguments.length?(e=f,h()):e},u.unknown=function(f){return arguments.length?(r=f,u):r},function(f,d){return i=f,s=d,h()}}function Eu(){return uv()(Zs,Zs)}function fv(n){return Math.abs(n=Math.round(n))>=1e21?n.toLocaleString("en").replace(/,/g,""):n.toString(10)}function qa(n,t){if(!isFinite(n)||n===0)return null;var e=(n=t?n.toExponential(t-1):n.toExponential()).indexOf("e"),i=n.slice(0,e);return[i.length>1?i[0]+i.slice(2):i,+n.slice(e+1)]}function Js(n){return n=qa(Math.abs(n)),n?n[1]:NaN}function dv(n,t){return function(e,i){for(var s=e.length,r=[],o=0,a=n[0],c=0;s>0&&a>0&&(c+a+1>i&&(a=Math.max(1,i-c)),r.push(e.substring(s-=a,s+a)),!((c+=a+1)>i));)a=n[o=(o+1)%n.length];return r.reverse().join(t)}}function pv(n){return function(t){return t.replace(/[0-9]/g,function(e){return n[+e]})}}var mv=/^(?:(.)?([<>=^]))?([+\-( ])?([$#])?(0)?(\d+)?(,)?(\.\d+)?(~)?([a-z%])?$/i;function so(n){if(!(t=mv.exec(n)))throw new Error("invalid format: "+n);var t;return new Tu({fill:t[1],align:t[2],sign:t[3],symbol:t[4],zero:t[5],width:t[6],comma:t[7],precision:t[8]&&t[8].slice(1),trim:t[9],type:t[10]})}so.prototype=Tu.prototype;function Tu(n){this.fill=n.fill===void 0?" ":n.fill+"",this.align=n.align===void 0?">":n.align+"",this.sign=n.sign===void 0?"-":n.sign+"",this.symbol=n.symbol===void 0?"":n.symbol+"",this.zero=!!n.zero,this.width=n.width===void 0?void 0:+n.width,this.comma=!!n.comma,this.precision=n.precision===void 0?void 0:+n.precision,this.trim=!!n.trim,this.type=n.type===void 0?"":n.type+""}Tu.prototype.toString=function(){return this.fill+this.align+this.sign+this.symbol+(this.zero?"0":"")+(this.width===void 0?"":Math.max(1,this.width|0))+(this.comma?",":"")+(this.precision===void 0?"":"."+Math.max(0,this.precision|0))+(this.trim?"~":"")+this.type};function gv(n){t:for(var t=n.length,e=1,i=-1,s;e<t;++e)switch(n[e]){case".":i=s=e;break;case"0":i===0&&(i=e),s=e;break;default:if(!+n[e])break t;i>0&&(i=0);break}return i>0?n.slice(0,i)+n.slice(s+1):n}var Ya;function _v(n,t){var e=qa(n,t);if(!e)return Ya=void 0,n.toPrecision(t);var i=e[0],s=e[1],r=s-(Ya=Math.max(-8,Math.min(8,Math.floor(s/3)))*3)+1,o=i.length;return r===o?i:r>o?i+new Array(r-o+1).join("0"):r>0?i.slice(0,r)+"."+i.slice(r):"0."+new Array(1-r).join("0")+qa(n,Math.max(0,t+r-1))[0]}function Nm(n,t){var e=qa(n,t);if(!e)return n+"";var i=e[0],s=e[1];return s<0?"0."+new Array(-s).join("0")+i:i.length>s+1?i.slice(0,s+1)+"."+i.slice(s+1):i+new Array(s-i.length+2).join("0")}var Dm={"%":(n,t)=>(n*100).toFixed(t),b:n=>Math.round(n).toString(2),c:n=>n+"",d:fv,e:(n,t)=>n.toExponential(t),f:(n,t)=>n.toFixed(t),g:(n,t)=>n.toPrecision(t),o:n=>Math.round(n).toString(8),p:(n,t)=>Nm(n*100,t),r:Nm,s:_v,X:n=>Math.round(n).toString(16).toUpperCase(),x:n=>Math.round(n).toString(16)};function Um(n){return n}var Om=Array.prototype.map,Fm=["y","z","a","f","p","n","\xB5","m","","k","M","G","T","P","E","Z","Y"];function xv(n){var t=n.grouping===void 0||n.thousands===void 0?Um:dv(Om.call(n.grouping,Number),n.thousands+""),e=n.currency===void 0?"":n.currency[0]+"",i=n.currency===void 0?"":n.currency[1]+"",s=n.decimal===void 0?".":n.decimal+"",r=n.numerals===void 0?Um:pv(Om.call(n.numerals,String)),o=n.percent===void 0?"%":n.percent+"",a=n.minus===void 0?"\u2212":n.minus+"",c=n.nan===void 0?"NaN":n.nan+"";function l(u,f){u=so(u);var d=u.fill,m=u.align,_=u.sign,p=u.symbol,g=u.zero,x=u.width,b=u.comma,v=u.precision,w=u.trim,E=u.type;E==="n"?(b=!0,E="g"):Dm[E]||(v===void 0&&(v=12),w=!0,E="g"),(g||d==="0"&&m==="=")&&(g=!0,d="0",m="=");var y=(f&&f.prefix!==void 0?f.prefix:"")+(p==="$"?e:p==="#"&&/[boxX]/.test(E)?"0"+E.toLowerCase():""),M=(p==="$"?i:/[%p]/.test(E)?o:"")+(f&&f.suffix!==void 0?f.suffix:""),L=Dm[E],R=/[defgprs%]/.test(E);v=v===void 0?6:/[gprs]/.test(E)?Math.max(1,Math.min(21,v)):Math.max(0,Math.min(20,v));function D(N){var B=y,C=M,z,$,G;if(E==="c")C=L(N)+C,N="";else{N=+N;var st=N<0||1/N<0;if(N=isNaN(N)?c:L(Math.abs(N),v),w&&(N=gv(N)),st&&+N==0&&_!=="+"&&(st=!1),B=(st?_==="("?_:a:_==="-"||_==="("?"":_)+B,C=(E==="s"&&!isNaN(N)&&Ya!==void 0?Fm[8+Ya/3]:"")+C+(st&&_==="("?")":""),R){for(z=-1,$=N.length;++z<$;)if(G=N.charCodeAt(z),48>G||G>57){C=(G===46?s+N.slice(z+1):N.slice(z))+C,N=N.slice(0,z);break}}}b&&!g&&(N=t(N,1/0));var X=B.length+N.length+C.length,Z=X<x?new Array(x-X+1).join(d):"";switch(b&&g&&(N=t(Z+N,Z.length?x-C.length:1/0),Z=""),m){case"<":N=B+N+C+Z;break;case"=":N=B+Z+N+C;break;case"^":N=Z.slice(0,X=Z.length>>1)+B+N+C+Z.slice(X);break;default:N=Z+B+N+C;break}return r(N)}return D.toString=function(){return u+""},D}function h(u,f){var d=Math.max(-8,Math.min(8,Math.floor(Js(f)/3)))*3,m=Math.pow(10,-d),_=l((u=so(u),u.type="f",u),{suffix:Fm[8+d/3]});return function(p){return _(m*p)}}return{format:l,formatPrefix:h}}var $a,Cu,Ru;yv({thousands:",",grouping:[3],currency:["$",""]});function yv(n){return $a=xv(n),Cu=$a.format,Ru=$a.formatPrefix,$a}function Bm(n){return Math.max(0,-Js(Math.abs(n)))}function km(n,t){return Math.max(0,Math.max(-8,Math.min(8,Math.floor(Js(t)/3)))*3-Js(Math.abs(n)))}function zm(n,t){return n=Math.abs(n),t=Math.abs(t)-n,Math.max(0,Js(t)-Js(n))+1}function Pu(n,t,e,i){var s=Yp(n,t,e),r;switch(i=so(i??",f"),i.type){case"s":{var o=Math.max(Math.abs(n),Math.abs(t));return i.precision==null&&!isNaN(r=km(s,o))&&(i.precision=r),Ru(i,o)}case"":case"e":case"g":case"p":case"r":{i.precision==null&&!isNaN(r=zm(s,Math.max(Math.abs(n),Math.abs(t))))&&(i.precision=r-(i.type==="e"));break}case"f":case"%":{i.precision==null&&!isNaN(r=Bm(s))&&(i.precision=r-(i.type==="%")*2);break}}return Cu(i)}function vv(n){var t=n.domain;return n.ticks=function(e){var i=t();return qp(i[0],i[i.length-1],e??10)},n.tickFormat=function(e,i){var s=t();return Pu(s[0],s[s.length-1],e??10,i)},n.nice=function(e){e==null&&(e=10);var i=t(),s=0,r=i.length-1,o=i[s],a=i[r],c,l,h=10;for(a<o&&(l=o,o=a,a=l,l=s,s=r,r=l);h-- >0;){if(l=Da(o,a,e),l===c)return i[s]=o,i[r]=a,t(i);if(l>0)o=Math.floor(o/l)*l,a=Math.ceil(a/l)*l;else if(l<0)o=Math.ceil(o*l)/l,a=Math.floor(a*l)/l;else break;c=l}return n},n}function oi(){var n=Eu();return n.copy=function(){return Lm(n,oi())},Zp.apply(n,arguments),vv(n)}function xs(n){return function(){return n}}var ro=Math.PI,Iu=2*ro,ys=1e-6,bv=Iu-ys;function Vm(n){this._+=n[0];for(let t=1,e=n.length;t<e;++t)this._+=arguments[t]+n[t]}function Mv(n){let t=Math.floor(n);if(!(t>=0))throw new Error(`invalid digits: ${n}`);if(t>15)return Vm;let e=10**t;return function(i){this._+=i[0];for(let s=1,r=i.length;s<r;++s)this._+=Math.round(arguments[s]*e)/e+i[s]}}function Gm(n,t,e,i){return n===e&&t===i}function Sv(n){let t=Math.floor(n);if(!(t<=15))return Gm;let e=10**t,i=function(s){return Math.round(s*e)};return function(s,r,o,a){return i(s)===i(o)&&i(r)===i(a)}}var js=class{constructor(t){this._x0=this._y0=this._x1=this._y1=null,this._="",this._append=t==null?Vm:Mv(t),this._equal=t==null?Gm:Sv(t)}moveTo(t,e){this._append`M${this._x0=this._x1=+t},${this._y0=this._y1=+e}`}closePath(){this._x1!==null&&(this._x1=this._x0,this._y1=this._y0,this._append`Z`)}lineTo(t,e){this._append`L${this._x1=+t},${this._y1=+e}`}quadraticCurveTo(t,e,i,s){this._append`Q${+t},${+e},${this._x1=+i},${this._y1=+s}`}bezierCurveTo(t,e,i,s,r,o){this._append`C${+t},${+e},${+i},${+s},${this._x1=+r},${this._y1=+o}`}arcTo(t,e,i,s,r){if(t=+t,e=+e,i=+i,s=+s,r=+r,r<0)throw new Error(`negative radius: ${r}`);let o=this._x1,a=this._y1,c=i-t,l=s-e,h=o-t,u=a-e,f=h*h+u*u;if(this._x1===null)this._append`M${this._x1=t},${this._y1=e}`;else if(f>ys)if(!(Math.abs(u*c-l*h)>ys)||!r)this._append`L${this._x1=t},${this._y1=e}`;else{let d=i-o,m=s-a,_=c*c+l*l,p=d*d+m*m,g=Math.sqrt(_),x=Math.sqrt(f),b=r*Math.tan((ro-Math.acos((_+f-p)/(2*g*x)))/2),v=b/x,w=b/g;Math.abs(v-1)>ys&&this._append`L${t+v*h},${e+v*u}`,this._append`A${r},${r},0,0,${+(u*d>h*m)},${this._x1=t+w*c},${this._y1=e+w*l}`}}arc(t,e,i,s,r,o){if(t=+t,e=+e,i=+i,o=!!o,i<0)throw new Error(`negative radius: ${i}`);let a=i*Math.cos(s),c=i*Math.sin(s),l=t+a,h=e+c,u=1^o,f=o?s-r:r-s;if(this._x1===null?this._append`M${l},${h}`:(Math.abs(this._x1-l)>ys||Math.abs(this._y1-h)>ys)&&this._append`L${l},${h}`,!!i){if(f<0&&(f=f%Iu+Iu),f>bv)this._append`A${i},${i},0,1,${u},${t-a},${e-c}A${i},${i},0,1,${u},${this._x1=l},${this._y1=h}`;else if(f>ys){let d=t+i*Math.cos(r),m=e+i*Math.sin(r);if(f>=ro&&this._equal(l,h,d,m)){f/=2;let _=s+f;this._append`A${i},${i},0,${+(f>=ro)},${u},${t+i*Math.cos(_)},${e+i*Math.sin(_)}`}this._append`A${i},${i},0,${+(f>=ro)},${u},${this._x1=d},${this._y1=m}`}}}rect(t,e,i,s){this._append`M${this._x0=this._x1=+t},${this._y0=this._y1=+e}h${i=+i}v${+s}h${-i}Z`}toString(){return this._}};function wv(){return new js}wv.prototype=js.prototype;function Hm(n){let t=3;return n.digits=function(e){if(!arguments.length)return t;if(e==null)t=null;else{let i=Math.floor(e);if(!(i>=0))throw new RangeError(`invalid digits: ${e}`);t=i}return n},()=>new js(t)}var zR=Array.prototype.slice;function Wm(n){return typeof n=="object"&&"length"in n?n:Array.from(n)}function Xm(n){this._context=n}Xm.prototype={areaStart:function(){this._line=0},areaEnd:function(){this._line=NaN},lineStart:function(){this._point=0},lineEnd:function(){(this._line||this._line!==0&&this._point===1)&&this._context.closePath(),this._line=1-this._line},point:function(n,t){switch(n=+n,t=+t,this._point){case 0:this._point=1,this._line?this._context.lineTo(n,t):this._context.moveTo(n,t);break;case 1:this._point=2;default:this._context.lineTo(n,t);break}}};function $m(n){return new Xm(n)}function qm(n){return n[0]}function Ym(n){return n[1]}function Lu(n,t){var e=xs(!0),i=null,s=$m,r=null,o=Hm(a);n=typeof n=="function"?n:n===void 0?qm:xs(n),t=typeof t=="function"?t:t===void 0?Ym:xs(t);function a(c){var l,h=(c=Wm(c)).length,u,f=!1,d;for(i==null&&(r=s(d=o())),l=0;l<=h;++l)!(l<h&&e(u=c[l],l,c))===f&&((f=!f)?r.lineStart():r.lineEnd()),f&&r.point(+n(u,l,c),+t(u,l,c));if(d)return r=null,d+""||null}return a.x=function(c){return arguments.length?(n=typeof c=="function"?c:xs(+c),a):n},a.y=function(c){return arguments.length?(t=typeof c=="function"?c:xs(+c),a):t},a.defined=function(c){return arguments.length?(e=typeof c=="function"?c:xs(!!c),a):e},a.curve=function(c){return arguments.length?(s=c,i!=null&&(r=s(i)),a):s},a.context=function(c){return arguments.length?(c==null?i=r=null:r=s(i=c),a):i},a}var vs={left:38,right:10,top:20,bottom:26},oo=n=>String(Number(n.toPrecision(6))).replace("-","\u2212");function Nu(n,t,e,{title:i,xUnit:s,yTicks:r=4,yFormat:o=oo}){let a=He("g",{class:"axes"});for(let l of e.ticks(r)){let h=e(l);a.append(He("path",{class:"grid",d:`M${n.x} ${h}H${n.x+n.width}`})),a.append(He("text",{x:n.x-6,y:h+3.5,"text-anchor":"end"},o(l)))}let c=n.y+n.height;if(a.append(He("path",{class:"axis",d:`M${n.x} ${c}H${n.x+n.width}`})),s!==void 0)for(let l of t.ticks(Math.max(3,n.width/70))){let h=t(l);a.append(He("path",{class:"axis",d:`M${h} ${c}v4`})),a.append(He("text",{x:h,y:c+15,"text-anchor":"middle"},oo(l)+s))}return a.append(He("text",{class:"title",x:n.x,y:n.y-7},i)),a}function Du(n,t,e){let i=Lu().defined(([s,r])=>Number.isFinite(s)&&Number.isFinite(r)).x(([s])=>Math.round(t(s)*10)/10).y(([,s])=>Math.round(e(s)*10)/10);return n.map(({points:s,colour:r,dashes:o,width:a})=>He("path",{class:"curve",d:i(s)??"",stroke:r,"stroke-width":a,...o?{"stroke-dasharray":o.map(c=>c*a).join(" ")}:{}}))}function Zm(n,t){let e=He("svg",{role:"img","aria-label":t});return n.append(e),{root:e,size(){let[i,s]=[Math.max(200,n.clientWidth),Math.max(120,n.clientHeight)];return e.setAttribute("viewBox",`0 0 ${i} ${s}`),{x:vs.left,y:vs.top,width:i-vs.left-vs.right,height:s-vs.top-vs.bottom}}}}function Jm(n){let{root:t,size:e}=Zm(n,"Angle of reflection against angle of incidence under each law");return{update(i,s,r,o,a){let c=e(),l=[...i.flatMap(({points:p})=>p.map(([,g])=>g)),...s.map(({reflection:p})=>p)].filter(Number.isFinite),h=Math.min(0,...l),u=oi([0,90],[c.x,c.x+c.width]),f=oi([Math.max(-90,Math.floor(h/15)*15),90],[c.y+c.height,c.y]),d=s.map(({incidence:p,reflection:g,stage:x})=>He("circle",{class:`measured ${x==="after_wall"?"early":""}`,cx:u(p).toFixed(1),cy:f(g).toFixed(1),r:2.6})),m=r===null?[]:[He("path",{class:"cursor",d:`M${u(r)} ${c.y}V${c.y+c.height}`})],_=r===null?[]:o.map(({colour:p,y:g})=>He("circle",{class:"now",cx:u(r).toFixed(1),cy:f(g).toFixed(1),r:3.4,fill:p}));t.replaceChildren(Nu(c,u,f,{title:"reflection over incidence",xUnit:"\xB0",yFormat:p=>`${oo(p)}\xB0`}),He("path",{class:"same",d:`M${u(0)} ${f(0)}L${u(90)} ${f(90)}`}),...d,...Du(i,u,f),...m,..._,...a?[He("text",{class:"missing",x:c.x+c.width/2,y:c.y+c.height/2,"text-anchor":"middle"},a)]:[])}}}function jm(n,t){let{root:e,size:i}=Zm(n,"Energy kept, and height of the ball or distance from the film, over time"),s=He("path",{class:"cursor"}),r={from:0,until:1},o=i(),a=l=>{let h=e.getBoundingClientRect(),u=(l.clientX-h.left)/h.width*(o.x+o.width+vs.right);t(r.from+Math.max(0,Math.min(1,(u-o.x)/o.width))*(r.until-r.from))};return e.addEventListener("pointerdown",l=>{e.setPointerCapture(l.pointerId),a(l)}),e.addEventListener("pointermove",l=>{l.buttons&&a(l)}),{place:l=>{let h=o.x+o.width*(Math.min(l,r.until)-r.from)/(r.until-r.from);s.setAttribute("d",`M${h.toFixed(1)} ${o.y}V${o.y+o.height}`)},update(l,h,u,f){o=i(),r=u;let d=Math.max(0,...h.flatMap(({points:v})=>v.map(([,w])=>w||0))),m=d>.001,_={...o,height:m?(o.height-24)*.52:o.height},p=oi([r.from,r.until],[o.x,o.x+o.width]),g=Math.max(1,...l.flatMap(({points:v})=>v.map(([,w])=>w))),x=oi([0,g*1.02],[_.y+_.height,_.y]),b=[Nu(_,p,x,{title:"energy kept over time",yTicks:m?2:4,yFormat:v=>`${oo(100*v)} %`,...m?{}:{xUnit:" s"}}),...Du(l,p,x)];if(m){let v={...o,y:_.y+_.height+24,height:o.height-_.height-24},w=d>500,E=oi([0,d*1.05],[v.y+v.height,v.y]),y=M=>oo(w?M/1e3:M);b.push(Nu(v,p,E,{title:`${f}, ${w?"m":"mm"}`,xUnit:" s",yTicks:2,yFormat:y}),...Du(h,p,E))}e.replaceChildren(...b,s)}}}function Km({speed:n,azimuth:t,elevation:e,offset:[i,s]}){let r=[i&&`${Ge(Math.abs(i))} to the ${i>0?"right":"left"}`,s&&`${Ge(Math.abs(s))} ${s>0?"up":"down"}`].filter(Boolean),o=r.length?`offset ${r.join(" and ")} (in ball radii)`:"at the centre";return`${Ge(n)} m/s, azimuth ${Ge(t,4)}\xB0, ${e?`elevation ${Ge(e)}\xB0, `:""}${o}`}var Qm=({velocity:n,spin:t,rolling:e,radius:i,mass:s,inertia:r})=>JSON.stringify([n,t,e,i,s,r]),tg=({balls:n,walls:t})=>JSON.stringify([n.map(({name:e})=>e),t.map(({shape:e})=>e)]);function eg(n){let t=n.find(({strikes:e})=>e);return(e,i)=>{let s=t?.strikes?.[i];return!t||!s||tg(e)!==tg(t.scene)?"":Qm(e.balls[i])===Qm(t.scene.balls[i])?`Struck by a cue: ${Km(s)}. Below are the velocity and the spin that it gives; changing one of them replaces the strike.`:`The cue's strike (${Km(s)}) is replaced by the velocity and the spin that are set here; undo brings it back.`}}var ng=[1/1e3,1/300,1/100,1/30,1/10,1/4,1/2,1,2,4],Uu=1e4;function ig(n,t){let e=$t("play"),i=$t("time"),s=$t("speed");i.max=String(Uu);for(let h of ng){let u=document.createElement("option");u.value=String(h),u.textContent=h<1?`1/${Math.round(1/h)} \xD7`:`${h} \xD7`,s.append(u)}let r=null;function o(h){if(!n.state.playing){r=null;return}let{until:u}=t(),f=r===null?0:Math.min((h-r)/1e3,.1);r=h;let d=Math.min(n.state.t+f*n.state.speed,u);n.change({t:d,playing:d<u},"time"),requestAnimationFrame(o)}function a(h){if(h===n.state.playing)return;let{from:u,until:f}=t(),d=h&&n.state.t>=f-1e-9*(f-u)?u:n.state.t;r=null,n.change({playing:h,t:d},"time"),h&&requestAnimationFrame(o)}function c(h){let{from:u,until:f}=t();n.change({t:Math.max(u,Math.min(h,f)),playing:!1},"time")}function l(h){let{events:u,from:f,until:d}=t(),m=n.state.t,_=1e-9*Math.max(d,.001),p=u.map(({t:x})=>x).filter(x=>x>=f&&x<=d),g=h>0?p.find(x=>x>m+_):p.findLast(x=>x<m-_);c(g??(h>0?d:f))}return e.onclick=()=>a(!n.state.playing),$t("next").onclick=()=>l(1),$t("previous").onclick=()=>l(-1),$t("restart").onclick=()=>c(t().from),i.oninput=()=>{let{from:h,until:u}=t();c(h+Number(i.value)/Uu*(u-h))},s.onchange=()=>n.change({speed:Number(s.value)},"time"),addEventListener("keydown",h=>{let u=h.target;if(h.ctrlKey||h.metaKey||h.altKey||/^(INPUT|SELECT|TEXTAREA)$/.test(u.tagName))return;let{from:f,until:d}=t(),m=(d-f)/200,_={" ":()=>a(!n.state.playing),ArrowLeft:()=>c(n.state.t-m*(h.shiftKey?10:1)),ArrowRight:()=>c(n.state.t+m*(h.shiftKey?10:1)),",":()=>l(-1),".":()=>l(1),Home:()=>c(f),End:()=>c(d)};h.key===" "&&u.tagName==="BUTTON"||Object.hasOwn(_,h.key)&&(h.preventDefault(),_[h.key]())}),{setPlaying:a,seek:c,update(){let{from:h,until:u,events:f}=t(),{t:d,playing:m}=n.state;i.value=String(Math.round((d-h)/(u-h)*Uu)),i.setAttribute("aria-valuetext",Zr(d)),$t("clock").textContent=`${Zr(d)} of ${Zr(u)}`,e.textContent=m?"Pause":"Play",e.setAttribute("aria-pressed",String(m)),s.value=String(ng.reduce((g,x)=>Math.abs(Math.log(x/n.state.speed))<Math.abs(Math.log(g/n.state.speed))?x:g));let _=1e-9*Math.max(u,.001),p=f.findLast(g=>g.t<=d+_);$t("event").textContent=p?`${Zr(p.t)}: ${p.text}`:""}}}var Av=.15,Ev=400;function og(n,t){let e=0,i=n.length-1;for(;e<i;){let s=e+i+1>>1;n[s].t<=t?e=s:i=s-1}return e}function Ks(n,t){let{x:e,v:i,w:s,acc:r,turn:o}=n;return{x:[e[0]+t*(i[0]+.5*t*r[0]),e[1]+t*(i[1]+.5*t*r[1]),e[2]+t*(i[2]+.5*t*r[2])],v:[i[0]+t*r[0],i[1]+t*r[1],i[2]+t*r[2]],w:[s[0]+t*o[0],s[1]+t*o[1],s[2]+t*o[2]],phase:n.phase}}function Mn(n,t){let e=n[og(n,t)];return Ks(e,Math.max(0,Math.min(t-e.t,e.lasts)))}function Tv(n,t){return[n[0]*t[0]-n[1]*t[1]-n[2]*t[2]-n[3]*t[3],n[0]*t[1]+n[1]*t[0]+n[2]*t[3]-n[3]*t[2],n[0]*t[2]-n[1]*t[3]+n[2]*t[0]+n[3]*t[1],n[0]*t[3]+n[1]*t[2]-n[2]*t[1]+n[3]*t[0]]}function Cv(n,t,e){let i=yn(t),s=i*e/2;if(s===0)return n;let r=Math.sin(s)/i;return Tv([Math.cos(s),t[0]*r,t[1]*r,t[2]*r],n)}function sg(n,t,e){let i=yn(t.turn)>0,s=Math.max(yn(t.w),yn(Ks(t,e).w))*e,r=i?Math.min(Ev,Math.max(1,Math.ceil(s/Av))):1;for(let o=0;o<r;o++)n=Cv(n,Ks(t,(o+.5)*e/r).w,e/r);return n}var Ui=class{constructor(t){this.pieces=t,this.starts=[[1,0,0,0]]}at(t){let{pieces:e,starts:i}=this,s=og(e,t);for(;i.length<=s;){let r=e[i.length-1];i.push(sg(i[i.length-1],r,Math.max(0,e[i.length].t-r.t)))}return sg(i[s],e[s],Math.max(0,Math.min(t-e[s].t,e[s].lasts)))}};function Rv(n){return n==="flight"||n==="bouncing"||n==="left"?"flight":n==="sliding"?"sliding":"rolling"}var Pv={flight:.001,sliding:.02,rolling:.02};function Qs(n,{from:t,until:e},i){let s=[];for(let r of n){let[o,a]=[Math.max(0,t-r.t),Math.min(r.lasts,e-r.t)],c=a-o;if(!(c>0))continue;let l=Rv(r.phase),{v:h,acc:u}=r,f=yn(ba(h,u))<1e-9*yn(h)*yn(u),d=yn(u)*c*c/8,m=f?1:Math.max(1,Math.min(32,Math.ceil(Math.sqrt(d/(Pv[l]*i))))),_=s[s.length-1];(!_||_.style!==l)&&s.push(_={style:l,points:[Ks(r,o).x]});let p=f?-ss(h,u)/ss(u,u):0;p>o&&p<a&&_.points.push(Ks(r,p).x);for(let g=1;g<=m;g++)_.points.push(Ks(r,o+c*g/m).x)}return s}var rg=300;function ag(n,{from:t,until:e}){let i=r=>r.lasts>(e-t)/5e3,s=Math.max(0,...n?.balls.map(({pieces:r})=>r.filter(i).length)??[]);return s>rg?.2*rg*(e-t)/s:1/0}function Za(n,t,e){let i=0;return n.balls.forEach((s,r)=>{let{x:o,v:a,w:c}=Mn(t.balls[r].pieces,e),l=n.floor?[o[0],o[1],o[2]-s.radius]:o;i+=qr(s,a,c)-s.mass*ss(Bs(n),l)}),i}function lg(n,t,{from:e,until:i},s){let r=new Set([i]);for(let a=0;a<s;a++)r.add(e+(i-e)*a/s);let o=4*s;for(let{t:a,lasts:c,acc:l}of n.balls[t].pieces){if(a>i||o<=0)break;if(!(a<e)){if(r.add(a),r.add(Math.min(i,a+c*(1-1e-9))),l[2]!==0&&c<(i-e)/20)for(let h=1;h<6;h++,o--)r.add(Math.min(i,a+c*h/6));o--}}return[...r].sort((a,c)=>a-c)}var Iv=.003,Ou=.15;function tr(n,t){let e=n.findLast(([c])=>c<=t)??n[0],i=n.find(([c])=>c>=t)??n[n.length-1];if(!e||t<e[0]-Ou||t>i[0]+Ou)return null;let[s,r,o]=i.map((c,l)=>c-e[l]);if(s>Ou&&Math.hypot(r,o)>Iv)return null;let a=s>0?(t-e[0])/s:0;return[e[1]+a*r,e[2]+a*o]}function Fu(n,t,e){let i=tr(n,e),{x:s}=Mn(t,e);return i&&Math.hypot(s[0]-i[0],s[1]-i[1])}function cg(n,t,{from:e,until:i}){let s=n.filter(([r])=>r>=e&&r<=i);return s.flatMap(([r],o)=>{let a=[[r,1e3*(Fu(n,t,r)??NaN)]];return o>0&&tr(n,(s[o-1][0]+r)/2)===null?[[NaN,NaN],...a]:a})}var Ja=class{constructor(t){this.state=t,this.listeners=[],this.past=[],this.future=[]}listen(t){this.listeners.push(t)}change(t,...e){Object.assign(this.state,t);let i=new Set(e);for(let s of this.listeners)s(i)}remember(){let t=JSON.stringify(this.state.scene);this.past[this.past.length-1]!==t&&(this.past.push(t),this.past.length>100&&this.past.shift(),this.future=[])}#t(t,e){let i=JSON.stringify(this.state.scene),s=t.pop();for(;s===i;)s=t.pop();if(s===void 0)return;e.push(i);let r=JSON.parse(s),o=Math.min(this.state.ball,r.balls.length-1);this.change({scene:r,ball:o,wall:Math.min(this.state.wall,r.walls.length-1)},"scene","laws")}undo(){this.#t(this.past,this.future)}redo(){this.#t(this.future,this.past)}};var qi={LEFT:0,MIDDLE:1,RIGHT:2,ROTATE:0,DOLLY:1,PAN:2},Yi={ROTATE:0,PAN:1,DOLLY_PAN:2,DOLLY_ROTATE:3},Kg=0,Sf=1,Qg=2;var Ko=1,t0=2,Dr=3,Zi=0,Ue=1,Tn=2,Ps=0,Ur=1,wf=2,Af=3,Ef=4,e0=5;var Is=100,n0=101,i0=102,s0=103,r0=104,o0=200,a0=201,l0=202,c0=203,Tf=204,Cf=205,h0=206,u0=207,f0=208,d0=209,p0=210,m0=211,g0=212,_0=213,x0=214,Rl=0,Pl=1,Il=2,yr=3,Ll=4,Nl=5,Dl=6,Ul=7,mc=0,y0=1,v0=2,Jn=0,Rf=1,Pf=2,If=3,Lf=4,Nf=5,Df=6,Uf=7;var Of=300,Ls=301,Or=302,gc=303,_c=304,Ol=1e3,qn=1001,Fl=1002,Pe=1003,b0=1004;var Qo=1005;var Ke=1006,xc=1007;var bi=1008;var rn=1009,Ff=1010,Bf=1011,Fr=1012,yc=1013,kn=1014,zn=1015,Vn=1016,vc=1017,bc=1018,Ns=1020,kf=35902,zf=35899,Vf=1021,Gf=1022,Gn=1023,pi=1026,Mi=1027,Hf=1028,Mc=1029,Ji=1030,Sc=1031;var wc=1033,ta=33776,ea=33777,na=33778,ia=33779,Ac=35840,Ec=35841,Tc=35842,Cc=35843,Rc=36196,Pc=37492,Ic=37496,Lc=37488,Nc=37489,sa=37490,Dc=37491,Uc=37808,Oc=37809,Fc=37810,Bc=37811,kc=37812,zc=37813,Vc=37814,Gc=37815,Hc=37816,Wc=37817,Xc=37818,$c=37819,qc=37820,Yc=37821,Zc=36492,Jc=36494,jc=36495,Kc=36283,Qc=36284,ra=36285,th=36286;var xo=2300,Bl=2301,Tl=2302,uf=2303,ff=2400,df=2401,pf=2402;var M0=3200;var eh=0,S0=1,Si="",Ze="srgb",yo="srgb-linear",vo="linear",se="srgb";var Cl=7680;var w0=519,A0=512,E0=513,T0=514,Wf=515,C0=516,R0=517,Xf=518,$f=519,qf=35044;var Yf="300 es",wn=2e3,vr=2001;function Lv(n){for(let t=n.length-1;t>=0;--t)if(n[t]>=65535)return!0;return!1}function Nv(n){return ArrayBuffer.isView(n)&&!(n instanceof DataView)}function bo(n){return document.createElementNS("http://www.w3.org/1999/xhtml",n)}function P0(){let n=bo("canvas");return n.style.display="block",n}var hg={},br=null;function Mo(...n){let t="THREE."+n.shift();br?br("log",t,...n):console.log(t,...n)}function I0(n){let t=n[0];if(typeof t=="string"&&t.startsWith("TSL:")){let e=n[1];e&&e.isStackTrace?n[0]+=" "+e.getLocation():n[1]='Stack trace not available. Enable "THREE.Node.captureStackTrace" to capture stack traces.'}return n}function Nt(...n){n=I0(n);let t="THREE."+n.shift();if(br)br("warn",t,...n);else{let e=n[0];e&&e.isStackTrace?console.warn(e.getError(t)):console.warn(t,...n)}}function Ot(...n){n=I0(n);let t="THREE."+n.shift();if(br)br("error",t,...n);else{let e=n[0];e&&e.isStackTrace?console.error(e.getError(t)):console.error(t,...n)}}function po(...n){let t=n.join(" ");t in hg||(hg[t]=!0,Nt(...n))}function L0(n,t,e){return new Promise(function(i,s){function r(){switch(n.clientWaitSync(t,n.SYNC_FLUSH_COMMANDS_BIT,0)){case n.WAIT_FAILED:s();break;case n.TIMEOUT_EXPIRED:setTimeout(r,e);break;default:i()}}setTimeout(r,e)})}var N0={[Rl]:Rl,[Il]:Dl,[Ll]:Ll,[yr]:Nl,[Pl]:Pl,[Dl]:Il,[Ul]:Ul,[Nl]:yr},Fn=class{addEventListener(t,e){this._listeners===void 0&&(this._listeners={});let i=this._listeners;i[t]===void 0&&(i[t]=[]),i[t].indexOf(e)===-1&&i[t].push(e)}hasEventListener(t,e){let i=this._listeners;return i===void 0?!1:i[t]!==void 0&&i[t].indexOf(e)!==-1}removeEventListener(t,e){let i=this._listeners;if(i===void 0)return;let s=i[t];if(s!==void 0){let r=s.indexOf(e);r!==-1&&s.splice(r,1)}}dispatchEvent(t){let e=this._listeners;if(e===void 0)return;let i=e[t.type];if(i!==void 0){t.target=this;let s=i.slice(0);for(let r=0,o=s.length;r<o;r++)s[r].call(this,t);t.target=null}}},We=["00","01","02","03","04","05","06","07","08","09","0a","0b","0c","0d","0e","0f","10","11","12","13","14","15","16","17","18","19","1a","1b","1c","1d","1e","1f","20","21","22","23","24","25","26","27","28","29","2a","2b","2c","2d","2e","2f","30","31","32","33","34","35","36","37","38","39","3a","3b","3c","3d","3e","3f","40","41","42","43","44","45","46","47","48","49","4a","4b","4c","4d","4e","4f","50","51","52","53","54","55","56","57","58","59","5a","5b","5c","5d","5e","5f","60","61","62","63","64","65","66","67","68","69","6a","6b","6c","6d","6e","6f","70","71","72","73","74","75","76","77","78","79","7a","7b","7c","7d","7e","7f","80","81","82","83","84","85","86","87","88","89","8a","8b","8c","8d","8e","8f","90","91","92","93","94","95","96","97","98","99","9a","9b","9c","9d","9e","9f","a0","a1","a2","a3","a4","a5","a6","a7","a8","a9","aa","ab","ac","ad","ae","af","b0","b1","b2","b3","b4","b5","b6","b7","b8","b9","ba","bb","bc","bd","be","bf","c0","c1","c2","c3","c4","c5","c6","c7","c8","c9","ca","cb","cc","cd","ce","cf","d0","d1","d2","d3","d4","d5","d6","d7","d8","d9","da","db","dc","dd","de","df","e0","e1","e2","e3","e4","e5","e6","e7","e8","e9","ea","eb","ec","ed","ee","ef","f0","f1","f2","f3","f4","f5","f6","f7","f8","f9","fa","fb","fc","fd","fe","ff"],ug=1234567,gr=Math.PI/180,Mr=180/Math.PI;function wi(){let n=Math.random()*4294967295|0,t=Math.random()*4294967295|0,e=Math.random()*4294967295|0,i=Math.random()*4294967295|0;return(We[n&255]+We[n>>8&255]+We[n>>16&255]+We[n>>24&255]+"-"+We[t&255]+We[t>>8&255]+"-"+We[t>>16&15|64]+We[t>>24&255]+"-"+We[e&63|128]+We[e>>8&255]+"-"+We[e>>16&255]+We[e>>24&255]+We[i&255]+We[i>>8&255]+We[i>>16&255]+We[i>>24&255]).toLowerCase()}function Ft(n,t,e){return Math.max(t,Math.min(e,n))}function Zf(n,t){return(n%t+t)%t}function Dv(n,t,e,i,s){return i+(n-t)*(s-i)/(e-t)}function Uv(n,t,e){return n!==t?(e-n)/(t-n):0}function mo(n,t,e){return(1-e)*n+e*t}function Ov(n,t,e,i){return mo(n,t,1-Math.exp(-e*i))}function Fv(n,t=1){return t-Math.abs(Zf(n,t*2)-t)}function Bv(n,t,e){return n<=t?0:n>=e?1:(n=(n-t)/(e-t),n*n*(3-2*n))}function kv(n,t,e){return n<=t?0:n>=e?1:(n=(n-t)/(e-t),n*n*n*(n*(n*6-15)+10))}function zv(n,t){return n+Math.floor(Math.random()*(t-n+1))}function Vv(n,t){return n+Math.random()*(t-n)}function Gv(n){return n*(.5-Math.random())}function Hv(n){n!==void 0&&(ug=n);let t=ug+=1831565813;return t=Math.imul(t^t>>>15,t|1),t^=t+Math.imul(t^t>>>7,t|61),((t^t>>>14)>>>0)/4294967296}function Wv(n){return n*gr}function Xv(n){return n*Mr}function $v(n){return n>0&&Number.isInteger(n)&&2**Math.round(Math.log2(n))===n}function qv(n){return Math.pow(2,Math.ceil(Math.log(n)/Math.LN2))}function Jf(n){return Math.pow(2,Math.floor(Math.log(n)/Math.LN2))}function Yv(n,t,e,i,s){let r=Math.cos,o=Math.sin,a=r(e/2),c=o(e/2),l=r((t+i)/2),h=o((t+i)/2),u=r((t-i)/2),f=o((t-i)/2),d=r((i-t)/2),m=o((i-t)/2);switch(s){case"XYX":n.set(a*h,c*u,c*f,a*l);break;case"YZY":n.set(c*f,a*h,c*u,a*l);break;case"ZXZ":n.set(c*u,c*f,a*h,a*l);break;case"XZX":n.set(a*h,c*m,c*d,a*l);break;case"YXY":n.set(c*d,a*h,c*m,a*l);break;case"ZYZ":n.set(c*m,c*d,a*h,a*l);break;default:Nt("MathUtils: .setQuaternionFromProperEuler() encountered an unknown order: "+s)}}function nh(n){switch(n.constructor){case Uint32Array:return 4294967295;case Uint16Array:return 65535;case Uint8Array:case Uint8ClampedArray:return 255;case Int32Array:return 2147483647;case Int16Array:return 32767;case Int8Array:return 127;default:return}}function jf(n,t){if(t.constructor===Float32Array)return n;let e=nh(t);if(e===void 0)throw new Error("THREE.MathUtils: Invalid component type.");return Math.max(n/e,-1)}function Kf(n,t){if(t.constructor===Float32Array)return n;let e=nh(t);if(e===void 0)throw new Error("THREE.MathUtils: Invalid component type.");return Math.round(n*e)}var oa={DEG2RAD:gr,RAD2DEG:Mr,generateUUID:wi,clamp:Ft,euclideanModulo:Zf,mapLinear:Dv,inverseLerp:Uv,lerp:mo,damp:Ov,pingpong:Fv,smoothstep:Bv,smootherstep:kv,randInt:zv,randFloat:Vv,randFloatSpread:Gv,seededRandom:Hv,degToRad:Wv,radToDeg:Xv,isPowerOfTwo:$v,ceilPowerOfTwo:qv,floorPowerOfTwo:Jf,setQuaternionFromProperEuler:Yv,normalize:Kf,denormalize:jf},ht=class{static{this.prototype.isVector2=!0}constructor(t=0,e=0){this.x=t,this.y=e}get width(){return this.x}set width(t){this.x=t}get height(){return this.y}set height(t){this.y=t}set(t,e){return this.x=t,this.y=e,this}setScalar(t){return this.x=t,this.y=t,this}setX(t){return this.x=t,this}setY(t){return this.y=t,this}setComponent(t,e){switch(t){case 0:this.x=e;break;case 1:this.y=e;break;default:throw new Error("THREE.Vector2: index is out of range: "+t)}return this}getComponent(t){switch(t){case 0:return this.x;case 1:return this.y;default:throw new Error("THREE.Vector2: index is out of range: "+t)}}clone(){return new this.constructor(this.x,this.y)}copy(t){return this.x=t.x,this.y=t.y,this}add(t){return this.x+=t.x,this.y+=t.y,this}addScalar(t){return this.x+=t,this.y+=t,this}addVectors(t,e){return this.x=t.x+e.x,this.y=t.y+e.y,this}addScaledVector(t,e){return this.x+=t.x*e,this.y+=t.y*e,this}sub(t){return this.x-=t.x,this.y-=t.y,this}subScalar(t){return this.x-=t,this.y-=t,this}subVectors(t,e){return this.x=t.x-e.x,this.y=t.y-e.y,this}multiply(t){return this.x*=t.x,this.y*=t.y,this}multiplyScalar(t){return this.x*=t,this.y*=t,this}divide(t){return this.x/=t.x,this.y/=t.y,this}divideScalar(t){return this.multiplyScalar(1/t)}applyMatrix3(t){let e=this.x,i=this.y,s=t.elements;return this.x=s[0]*e+s[3]*i+s[6],this.y=s[1]*e+s[4]*i+s[7],this}min(t){return this.x=Math.min(this.x,t.x),this.y=Math.min(this.y,t.y),this}max(t){return this.x=Math.max(this.x,t.x),this.y=Math.max(this.y,t.y),this}clamp(t,e){return this.x=Ft(this.x,t.x,e.x),this.y=Ft(this.y,t.y,e.y),this}clampScalar(t,e){return this.x=Ft(this.x,t,e),this.y=Ft(this.y,t,e),this}clampLength(t,e){let i=this.length();return this.divideScalar(i||1).multiplyScalar(Ft(i,t,e))}floor(){return this.x=Math.floor(this.x),this.y=Math.floor(this.y),this}ceil(){return this.x=Math.ceil(this.x),this.y=Math.ceil(this.y),this}round(){return this.x=Math.round(this.x),this.y=Math.round(this.y),this}roundToZero(){return this.x=Math.trunc(this.x),this.y=Math.trunc(this.y),this}negate(){return this.x=-this.x,this.y=-this.y,this}dot(t){return this.x*t.x+this.y*t.y}cross(t){return this.x*t.y-this.y*t.x}lengthSq(){return this.x*this.x+this.y*this.y}length(){return Math.sqrt(this.x*this.x+this.y*this.y)}manhattanLength(){return Math.abs(this.x)+Math.abs(this.y)}normalize(){return this.divideScalar(this.length()||1)}angle(){return Math.atan2(-this.y,-this.x)+Math.PI}angleTo(t){let e=Math.sqrt(this.lengthSq()*t.lengthSq());if(e===0)return Math.PI/2;let i=this.dot(t)/e;return Math.acos(Ft(i,-1,1))}distanceTo(t){return Math.sqrt(this.distanceToSquared(t))}distanceToSquared(t){let e=this.x-t.x,i=this.y-t.y;return e*e+i*i}manhattanDistanceTo(t){return Math.abs(this.x-t.x)+Math.abs(this.y-t.y)}setLength(t){return this.normalize().multiplyScalar(t)}lerp(t,e){return this.x+=(t.x-this.x)*e,this.y+=(t.y-this.y)*e,this}lerpVectors(t,e,i){return this.x=t.x+(e.x-t.x)*i,this.y=t.y+(e.y-t.y)*i,this}equals(t){return t.x===this.x&&t.y===this.y}fromArray(t,e=0){return this.x=t[e],this.y=t[e+1],this}toArray(t=[],e=0){return t[e]=this.x,t[e+1]=this.y,t}fromBufferAttribute(t,e){return this.x=t.getX(e),this.y=t.getY(e),this}rotateAround(t,e){let i=Math.cos(e),s=Math.sin(e),r=this.x-t.x,o=this.y-t.y;return this.x=r*i-o*s+t.x,this.y=r*s+o*i+t.y,this}random(){return this.x=Math.random(),this.y=Math.random(),this}*[Symbol.iterator](){yield this.x,yield this.y}},Ne=class{constructor(t=0,e=0,i=0,s=1){this.isQuaternion=!0,this._x=t,this._y=e,this._z=i,this._w=s}static slerpFlat(t,e,i,s,r,o,a){let c=i[s+0],l=i[s+1],h=i[s+2],u=i[s+3],f=r[o+0],d=r[o+1],m=r[o+2],_=r[o+3];if(u!==_||c!==f||l!==d||h!==m){let p=c*f+l*d+h*m+u*_;p<0&&(f=-f,d=-d,m=-m,_=-_,p=-p);let g=1-a;if(p<.9995){let x=Math.acos(p),b=Math.sin(x);g=Math.sin(g*x)/b,a=Math.sin(a*x)/b,c=c*g+f*a,l=l*g+d*a,h=h*g+m*a,u=u*g+_*a}else{c=c*g+f*a,l=l*g+d*a,h=h*g+m*a,u=u*g+_*a;let x=1/Math.sqrt(c*c+l*l+h*h+u*u);c*=x,l*=x,h*=x,u*=x}}t[e]=c,t[e+1]=l,t[e+2]=h,t[e+3]=u}static multiplyQuaternionsFlat(t,e,i,s,r,o){let a=i[s],c=i[s+1],l=i[s+2],h=i[s+3],u=r[o],f=r[o+1],d=r[o+2],m=r[o+3];return t[e]=a*m+h*u+c*d-l*f,t[e+1]=c*m+h*f+l*u-a*d,t[e+2]=l*m+h*d+a*f-c*u,t[e+3]=h*m-a*u-c*f-l*d,t}get x(){return this._x}set x(t){this._x=t,this._onChangeCallback()}get y(){return this._y}set y(t){this._y=t,this._onChangeCallback()}get z(){return this._z}set z(t){this._z=t,this._onChangeCallback()}get w(){return this._w}set w(t){this._w=t,this._onChangeCallback()}set(t,e,i,s){return this._x=t,this._y=e,this._z=i,this._w=s,this._onChangeCallback(),this}clone(){return new this.constructor(this._x,this._y,this._z,this._w)}copy(t){return this._x=t.x,this._y=t.y,this._z=t.z,this._w=t.w,this._onChangeCallback(),this}setFromEuler(t,e=!0){let i=t._x,s=t._y,r=t._z,o=t._order,a=Math.cos,c=Math.sin,l=a(i/2),h=a(s/2),u=a(r/2),f=c(i/2),d=c(s/2),m=c(r/2);switch(o){case"XYZ":this._x=f*h*u+l*d*m,this._y=l*d*u-f*h*m,this._z=l*h*m+f*d*u,this._w=l*h*u-f*d*m;break;case"YXZ":this._x=f*h*u+l*d*m,this._y=l*d*u-f*h*m,this._z=l*h*m-f*d*u,this._w=l*h*u+f*d*m;break;case"ZXY":this._x=f*h*u-l*d*m,this._y=l*d*u+f*h*m,this._z=l*h*m+f*d*u,this._w=l*h*u-f*d*m;break;case"ZYX":this._x=f*h*u-l*d*m,this._y=l*d*u+f*h*m,this._z=l*h*m-f*d*u,this._w=l*h*u+f*d*m;break;case"YZX":this._x=f*h*u+l*d*m,this._y=l*d*u+f*h*m,this._z=l*h*m-f*d*u,this._w=l*h*u-f*d*m;break;case"XZY":this._x=f*h*u-l*d*m,this._y=l*d*u-f*h*m,this._z=l*h*m+f*d*u,this._w=l*h*u+f*d*m;break;default:Nt("Quaternion: .setFromEuler() encountered an unknown order: "+o)}return e===!0&&this._onChangeCallback(),this}setFromAxisAngle(t,e){let i=e/2,s=Math.sin(i);return this._x=t.x*s,this._y=t.y*s,this._z=t.z*s,this._w=Math.cos(i),this._onChangeCallback(),this}setFromRotationMatrix(t){let e=t.elements,i=e[0],s=e[4],r=e[8],o=e[1],a=e[5],c=e[9],l=e[2],h=e[6],u=e[10],f=i+a+u;if(f>0){let d=.5/Math.sqrt(f+1);this._w=.25/d,this._x=(h-c)*d,this._y=(r-l)*d,this._z=(o-s)*d}else if(i>a&&i>u){let d=2*Math.sqrt(1+i-a-u);this._w=(h-c)/d,this._x=.25*d,this._y=(s+o)/d,this._z=(r+l)/d}else if(a>u){let d=2*Math.sqrt(1+a-i-u);this._w=(r-l)/d,this._x=(s+o)/d,this._y=.25*d,this._z=(c+h)/d}else{let d=2*Math.sqrt(1+u-i-a);this._w=(o-s)/d,this._x=(r+l)/d,this._y=(c+h)/d,this._z=.25*d}return this._onChangeCallback(),this}setFromUnitVectors(t,e){let i=t.dot(e)+1;return i<1e-8?(i=0,Math.abs(t.x)>Math.abs(t.z)?(this._x=-t.y,this._y=t.x,this._z=0,this._w=i):(this._x=0,this._y=-t.z,this._z=t.y,this._w=i)):(this._x=t.y*e.z-t.z*e.y,this._y=t.z*e.x-t.x*e.z,this._z=t.x*e.y-t.y*e.x,this._w=i),this.normalize()}angleTo(t){return 2*Math.acos(Math.abs(Ft(this.dot(t),-1,1)))}rotateTowards(t,e){let i=this.angleTo(t);if(i===0)return this;let s=Math.min(1,e/i);return this.slerp(t,s),this}identity(){return this.set(0,0,0,1)}invert(){return this.conjugate()}conjugate(){return this._x*=-1,this._y*=-1,this._z*=-1,this._onChangeCallback(),this}dot(t){return this._x*t._x+this._y*t._y+this._z*t._z+this._w*t._w}lengthSq(){return this._x*this._x+this._y*this._y+this._z*this._z+this._w*this._w}length(){return Math.sqrt(this._x*this._x+this._y*this._y+this._z*this._z+this._w*this._w)}normalize(){let t=this.length();return t===0?(this._x=0,this._y=0,this._z=0,this._w=1):(t=1/t,this._x=this._x*t,this._y=this._y*t,this._z=this._z*t,this._w=this._w*t),this._onChangeCallback(),this}multiply(t){return this.multiplyQuaternions(this,t)}premultiply(t){return this.multiplyQuaternions(t,this)}multiplyQuaternions(t,e){let i=t._x,s=t._y,r=t._z,o=t._w,a=e._x,c=e._y,l=e._z,h=e._w;return this._x=i*h+o*a+s*l-r*c,this._y=s*h+o*c+r*a-i*l,this._z=r*h+o*l+i*c-s*a,this._w=o*h-i*a-s*c-r*l,this._onChangeCallback(),this}slerp(t,e){let i=t._x,s=t._y,r=t._z,o=t._w,a=this.dot(t);a<0&&(i=-i,s=-s,r=-r,o=-o,a=-a);let c=1-e;if(a<.9995){let l=Math.acos(a),h=Math.sin(l);c=Math.sin(c*l)/h,e=Math.sin(e*l)/h,this._x=this._x*c+i*e,this._y=this._y*c+s*e,this._z=this._z*c+r*e,this._w=this._w*c+o*e,this._onChangeCallback()}else this._x=this._x*c+i*e,this._y=this._y*c+s*e,this._z=this._z*c+r*e,this._w=this._w*c+o*e,this.normalize();return this}slerpQuaternions(t,e,i){return this.copy(t).slerp(e,i)}random(){let t=2*Math.PI*Math.random(),e=2*Math.PI*Math.random(),i=Math.random(),s=Math.sqrt(1-i),r=Math.sqrt(i);return this.set(s*Math.sin(t),s*Math.cos(t),r*Math.sin(e),r*Math.cos(e))}equals(t){return t._x===this._x&&t._y===this._y&&t._z===this._z&&t._w===this._w}fromArray(t,e=0){return this._x=t[e],this._y=t[e+1],this._z=t[e+2],this._w=t[e+3],this._onChangeCallback(),this}toArray(t=[],e=0){return t[e]=this._x,t[e+1]=this._y,t[e+2]=this._z,t[e+3]=this._w,t}fromBufferAttribute(t,e){return this._x=t.getX(e),this._y=t.getY(e),this._z=t.getZ(e),this._w=t.getW(e),this._onChangeCallback(),this}toJSON(){return this.toArray()}_onChange(t){return this._onChangeCallback=t,this}_onChangeCallback(){}*[Symbol.iterator](){yield this._x,yield this._y,yield this._z,yield this._w}},P=class{static{this.prototype.isVector3=!0}constructor(t=0,e=0,i=0){this.x=t,this.y=e,this.z=i}set(t,e,i){return i===void 0&&(i=this.z),this.x=t,this.y=e,this.z=i,this}setScalar(t){return this.x=t,this.y=t,this.z=t,this}setX(t){return this.x=t,this}setY(t){return this.y=t,this}setZ(t){return this.z=t,this}setComponent(t,e){switch(t){case 0:this.x=e;break;case 1:this.y=e;break;case 2:this.z=e;break;default:throw new Error("THREE.Vector3: index is out of range: "+t)}return this}getComponent(t){switch(t){case 0:return this.x;case 1:return this.y;case 2:return this.z;default:throw new Error("THREE.Vector3: index is out of range: "+t)}}clone(){return new this.constructor(this.x,this.y,this.z)}copy(t){return this.x=t.x,this.y=t.y,this.z=t.z,this}add(t){return this.x+=t.x,this.y+=t.y,this.z+=t.z,this}addScalar(t){return this.x+=t,this.y+=t,this.z+=t,this}addVectors(t,e){return this.x=t.x+e.x,this.y=t.y+e.y,this.z=t.z+e.z,this}addScaledVector(t,e){return this.x+=t.x*e,this.y+=t.y*e,this.z+=t.z*e,this}sub(t){return this.x-=t.x,this.y-=t.y,this.z-=t.z,this}subScalar(t){return this.x-=t,this.y-=t,this.z-=t,this}subVectors(t,e){return this.x=t.x-e.x,this.y=t.y-e.y,this.z=t.z-e.z,this}multiply(t){return this.x*=t.x,this.y*=t.y,this.z*=t.z,this}multiplyScalar(t){return this.x*=t,this.y*=t,this.z*=t,this}multiplyVectors(t,e){return this.x=t.x*e.x,this.y=t.y*e.y,this.z=t.z*e.z,this}applyEuler(t){return this.applyQuaternion(fg.setFromEuler(t))}applyAxisAngle(t,e){return this.applyQuaternion(fg.setFromAxisAngle(t,e))}applyMatrix3(t){let e=this.x,i=this.y,s=this.z,r=t.elements;return this.x=r[0]*e+r[3]*i+r[6]*s,this.y=r[1]*e+r[4]*i+r[7]*s,this.z=r[2]*e+r[5]*i+r[8]*s,this}applyNormalMatrix(t){return this.applyMatrix3(t).normalize()}applyMatrix4(t){let e=this.x,i=this.y,s=this.z,r=t.elements,o=1/(r[3]*e+r[7]*i+r[11]*s+r[15]);return this.x=(r[0]*e+r[4]*i+r[8]*s+r[12])*o,this.y=(r[1]*e+r[5]*i+r[9]*s+r[13])*o,this.z=(r[2]*e+r[6]*i+r[10]*s+r[14])*o,this}applyQuaternion(t){let e=this.x,i=this.y,s=this.z,r=t.x,o=t.y,a=t.z,c=t.w,l=2*(o*s-a*i),h=2*(a*e-r*s),u=2*(r*i-o*e);return this.x=e+c*l+o*u-a*h,this.y=i+c*h+a*l-r*u,this.z=s+c*u+r*h-o*l,this}project(t){return this.applyMatrix4(t.matrixWorldInverse).applyMatrix4(t.projectionMatrix)}unproject(t){return this.applyMatrix4(t.projectionMatrixInverse).applyMatrix4(t.matrixWorld)}transformDirection(t){let e=this.x,i=this.y,s=this.z,r=t.elements;return this.x=r[0]*e+r[4]*i+r[8]*s,this.y=r[1]*e+r[5]*i+r[9]*s,this.z=r[2]*e+r[6]*i+r[10]*s,this.normalize()}divide(t){return this.x/=t.x,this.y/=t.y,this.z/=t.z,this}divideScalar(t){return this.multiplyScalar(1/t)}min(t){return this.x=Math.min(this.x,t.x),this.y=Math.min(this.y,t.y),this.z=Math.min(this.z,t.z),this}max(t){return this.x=Math.max(this.x,t.x),this.y=Math.max(this.y,t.y),this.z=Math.max(this.z,t.z),this}clamp(t,e){return this.x=Ft(this.x,t.x,e.x),this.y=Ft(this.y,t.y,e.y),this.z=Ft(this.z,t.z,e.z),this}clampScalar(t,e){return this.x=Ft(this.x,t,e),this.y=Ft(this.y,t,e),this.z=Ft(this.z,t,e),this}clampLength(t,e){let i=this.length();return this.divideScalar(i||1).multiplyScalar(Ft(i,t,e))}floor(){return this.x=Math.floor(this.x),this.y=Math.floor(this.y),this.z=Math.floor(this.z),this}ceil(){return this.x=Math.ceil(this.x),this.y=Math.ceil(this.y),this.z=Math.ceil(this.z),this}round(){return this.x=Math.round(this.x),this.y=Math.round(this.y),this.z=Math.round(this.z),this}roundToZero(){return this.x=Math.trunc(this.x),this.y=Math.trunc(this.y),this.z=Math.trunc(this.z),this}negate(){return this.x=-this.x,this.y=-this.y,this.z=-this.z,this}dot(t){return this.x*t.x+this.y*t.y+this.z*t.z}lengthSq(){return this.x*this.x+this.y*this.y+this.z*this.z}length(){return Math.sqrt(this.x*this.x+this.y*this.y+this.z*this.z)}manhattanLength(){return Math.abs(this.x)+Math.abs(this.y)+Math.abs(this.z)}normalize(){return this.divideScalar(this.length()||1)}setLength(t){return this.normalize().multiplyScalar(t)}lerp(t,e){return this.x+=(t.x-this.x)*e,this.y+=(t.y-this.y)*e,this.z+=(t.z-this.z)*e,this}lerpVectors(t,e,i){return this.x=t.x+(e.x-t.x)*i,this.y=t.y+(e.y-t.y)*i,this.z=t.z+(e.z-t.z)*i,this}cross(t){return this.crossVectors(this,t)}crossVectors(t,e){let i=t.x,s=t.y,r=t.z,o=e.x,a=e.y,c=e.z;return this.x=s*c-r*a,this.y=r*o-i*c,this.z=i*a-s*o,this}projectOnVector(t){let e=t.lengthSq();if(e===0)return this.set(0,0,0);let i=t.dot(this)/e;return this.copy(t).multiplyScalar(i)}projectOnPlane(t){return Bu.copy(this).projectOnVector(t),this.sub(Bu)}reflect(t){return this.sub(Bu.copy(t).multiplyScalar(2*this.dot(t)))}angleTo(t){let e=Math.sqrt(this.lengthSq()*t.lengthSq());if(e===0)return Math.PI/2;let i=this.dot(t)/e;return Math.acos(Ft(i,-1,1))}distanceTo(t){return Math.sqrt(this.distanceToSquared(t))}distanceToSquared(t){let e=this.x-t.x,i=this.y-t.y,s=this.z-t.z;return e*e+i*i+s*s}manhattanDistanceTo(t){return Math.abs(this.x-t.x)+Math.abs(this.y-t.y)+Math.abs(this.z-t.z)}setFromSpherical(t){return this.setFromSphericalCoords(t.radius,t.phi,t.theta)}setFromSphericalCoords(t,e,i){let s=Math.sin(e)*t;return this.x=s*Math.sin(i),this.y=Math.cos(e)*t,this.z=s*Math.cos(i),this}setFromCylindrical(t){return this.setFromCylindricalCoords(t.radius,t.theta,t.y)}setFromCylindricalCoords(t,e,i){return this.x=t*Math.sin(e),this.y=i,this.z=t*Math.cos(e),this}setFromMatrixPosition(t){let e=t.elements;return this.x=e[12],this.y=e[13],this.z=e[14],this}setFromMatrixScale(t){let e=this.setFromMatrixColumn(t,0).length(),i=this.setFromMatrixColumn(t,1).length(),s=this.setFromMatrixColumn(t,2).length();return this.x=e,this.y=i,this.z=s,this}setFromMatrixColumn(t,e){return this.fromArray(t.elements,e*4)}setFromMatrix3Column(t,e){return this.fromArray(t.elements,e*3)}setFromEuler(t){return this.x=t._x,this.y=t._y,this.z=t._z,this}setFromColor(t){return this.x=t.r,this.y=t.g,this.z=t.b,this}equals(t){return t.x===this.x&&t.y===this.y&&t.z===this.z}fromArray(t,e=0){return this.x=t[e],this.y=t[e+1],this.z=t[e+2],this}toArray(t=[],e=0){return t[e]=this.x,t[e+1]=this.y,t[e+2]=this.z,t}fromBufferAttribute(t,e){return this.x=t.getX(e),this.y=t.getY(e),this.z=t.getZ(e),this}random(){return this.x=Math.random(),this.y=Math.random(),this.z=Math.random(),this}randomDirection(){let t=Math.random()*Math.PI*2,e=Math.random()*2-1,i=Math.sqrt(1-e*e);return this.x=i*Math.cos(t),this.y=e,this.z=i*Math.sin(t),this}*[Symbol.iterator](){yield this.x,yield this.y,yield this.z}},Bu=new P,fg=new Ne,Bt=class{static{this.prototype.isMatrix3=!0}constructor(t,e,i,s,r,o,a,c,l){this.elements=[1,0,0,0,1,0,0,0,1],t!==void 0&&this.set(t,e,i,s,r,o,a,c,l)}set(t,e,i,s,r,o,a,c,l){let h=this.elements;return h[0]=t,h[1]=s,h[2]=a,h[3]=e,h[4]=r,h[5]=c,h[6]=i,h[7]=o,h[8]=l,this}identity(){return this.set(1,0,0,0,1,0,0,0,1),this}copy(t){let e=this.elements,i=t.elements;return e[0]=i[0],e[1]=i[1],e[2]=i[2],e[3]=i[3],e[4]=i[4],e[5]=i[5],e[6]=i[6],e[7]=i[7],e[8]=i[8],this}extractBasis(t,e,i){return t.setFromMatrix3Column(this,0),e.setFromMatrix3Column(this,1),i.setFromMatrix3Column(this,2),this}setFromMatrix4(t){let e=t.elements;return this.set(e[0],e[4],e[8],e[1],e[5],e[9],e[2],e[6],e[10]),this}multiply(t){return this.multiplyMatrices(this,t)}premultiply(t){return this.multiplyMatrices(t,this)}multiplyMatrices(t,e){let i=t.elements,s=e.elements,r=this.elements,o=i[0],a=i[3],c=i[6],l=i[1],h=i[4],u=i[7],f=i[2],d=i[5],m=i[8],_=s[0],p=s[3],g=s[6],x=s[1],b=s[4],v=s[7],w=s[2],E=s[5],y=s[8];return r[0]=o*_+a*x+c*w,r[3]=o*p+a*b+c*E,r[6]=o*g+a*v+c*y,r[1]=l*_+h*x+u*w,r[4]=l*p+h*b+u*E,r[7]=l*g+h*v+u*y,r[2]=f*_+d*x+m*w,r[5]=f*p+d*b+m*E,r[8]=f*g+d*v+m*y,this}multiplyScalar(t){let e=this.elements;return e[0]*=t,e[3]*=t,e[6]*=t,e[1]*=t,e[4]*=t,e[7]*=t,e[2]*=t,e[5]*=t,e[8]*=t,this}determinant(){let t=this.elements,e=t[0],i=t[1],s=t[2],r=t[3],o=t[4],a=t[5],c=t[6],l=t[7],h=t[8];return e*o*h-e*a*l-i*r*h+i*a*c+s*r*l-s*o*c}invert(){let t=this.elements,e=t[0],i=t[1],s=t[2],r=t[3],o=t[4],a=t[5],c=t[6],l=t[7],h=t[8],u=h*o-a*l,f=a*c-h*r,d=l*r-o*c,m=e*u+i*f+s*d;if(m===0)return this.set(0,0,0,0,0,0,0,0,0);let _=1/m;return t[0]=u*_,t[1]=(s*l-h*i)*_,t[2]=(a*i-s*o)*_,t[3]=f*_,t[4]=(h*e-s*c)*_,t[5]=(s*r-a*e)*_,t[6]=d*_,t[7]=(i*c-l*e)*_,t[8]=(o*e-i*r)*_,this}transpose(){let t,e=this.elements;return t=e[1],e[1]=e[3],e[3]=t,t=e[2],e[2]=e[6],e[6]=t,t=e[5],e[5]=e[7],e[7]=t,this}getNormalMatrix(t){return this.setFromMatrix4(t).invert().transpose()}transposeIntoArray(t){let e=this.elements;return t[0]=e[0],t[1]=e[3],t[2]=e[6],t[3]=e[1],t[4]=e[4],t[5]=e[7],t[6]=e[2],t[7]=e[5],t[8]=e[8],this}setUvTransform(t,e,i,s,r,o,a){let c=Math.cos(r),l=Math.sin(r);return this.set(i*c,i*l,-i*(c*o+l*a)+o+t,-s*l,s*c,-s*(-l*o+c*a)+a+e,0,0,1),this}scale(t,e){return po("Matrix3: .scale() is deprecated. Use .makeScale() instead."),this.premultiply(ku.makeScale(t,e)),this}rotate(t){return po("Matrix3: .rotate() is deprecated. Use .makeRotation() instead."),this.premultiply(ku.makeRotation(-t)),this}translate(t,e){return po("Matrix3: .translate() is deprecated. Use .makeTranslation() instead."),this.premultiply(ku.makeTranslation(t,e)),this}makeTranslation(t,e){return t.isVector2?this.set(1,0,t.x,0,1,t.y,0,0,1):this.set(1,0,t,0,1,e,0,0,1),this}makeRotation(t){let e=Math.cos(t),i=Math.sin(t);return this.set(e,-i,0,i,e,0,0,0,1),this}makeScale(t,e){return this.set(t,0,0,0,e,0,0,0,1),this}equals(t){let e=this.elements,i=t.elements;for(let s=0;s<9;s++)if(e[s]!==i[s])return!1;return!0}fromArray(t,e=0){for(let i=0;i<9;i++)this.elements[i]=t[i+e];return this}toArray(t=[],e=0){let i=this.elements;return t[e]=i[0],t[e+1]=i[1],t[e+2]=i[2],t[e+3]=i[3],t[e+4]=i[4],t[e+5]=i[5],t[e+6]=i[6],t[e+7]=i[7],t[e+8]=i[8],t}clone(){return new this.constructor().fromArray(this.elements)}},ku=new Bt,dg=new Bt().set(.4123908,.3575843,.1804808,.212639,.7151687,.0721923,.0193308,.1191948,.9505322),pg=new Bt().set(3.2409699,-1.5373832,-.4986108,-.9692436,1.8759675,.0415551,.0556301,-.203977,1.0569715);function Zv(){let n={enabled:!0,workingColorSpace:yo,spaces:{},convert:function(s,r,o){return this.enabled===!1||r===o||!r||!o||(this.spaces[r].transfer===se&&(s.r=di(s.r),s.g=di(s.g),s.b=di(s.b)),this.spaces[r].primaries!==this.spaces[o].primaries&&(s.applyMatrix3(this.spaces[r].toXYZ),s.applyMatrix3(this.spaces[o].fromXYZ)),this.spaces[o].transfer===se&&(s.r=_r(s.r),s.g=_r(s.g),s.b=_r(s.b))),s},workingToColorSpace:function(s,r){return this.convert(s,this.workingColorSpace,r)},colorSpaceToWorking:function(s,r){return this.convert(s,r,this.workingColorSpace)},getPrimaries:function(s){return this.spaces[s].primaries},getTransfer:function(s){return s===Si?vo:this.spaces[s].transfer},getToneMappingMode:function(s){return this.spaces[s].outputColorSpaceConfig.toneMappingMode||"standard"},getLuminanceCoefficients:function(s,r=this.workingColorSpace){return s.fromArray(this.spaces[r].luminanceCoefficients)},define:function(s){Object.assign(this.spaces,s)},_getMatrix:function(s,r,o){return s.copy(this.spaces[o].fromXYZ).multiply(this.spaces[r].toXYZ)},_getDrawingBufferColorSpace:function(s){return this.spaces[s].outputColorSpaceConfig.drawingBufferColorSpace},_getUnpackColorSpace:function(s=this.workingColorSpace){return this.spaces[s].workingColorSpaceConfig.unpackColorSpace}},t=[.64,.33,.3,.6,.15,.06],e=[.2126,.7152,.0722],i=[.3127,.329];return n.define({[yo]:{primaries:t,whitePoint:i,transfer:vo,toXYZ:dg,fromXYZ:pg,luminanceCoefficients:e,workingColorSpaceConfig:{unpackColorSpace:Ze},outputColorSpaceConfig:{drawingBufferColorSpace:Ze}},[Ze]:{primaries:t,whitePoint:i,transfer:se,toXYZ:dg,fromXYZ:pg,luminanceCoefficients:e,outputColorSpaceConfig:{drawingBufferColorSpace:Ze}}}),n}var Jt=Zv();function di(n){return n<.04045?n*.0773993808:Math.pow(n*.9478672986+.0521327014,2.4)}function _r(n){return n<.0031308?n*12.92:1.055*Math.pow(n,.41666)-.055}var er,kl=class{static getDataURL(t,e="image/png"){if(/^data:/i.test(t.src)||typeof HTMLCanvasElement>"u")return t.src;let i;if(t instanceof HTMLCanvasElement)i=t;else{er===void 0&&(er=bo("canvas")),er.width=t.width,er.height=t.height;let s=er.getContext("2d");t instanceof ImageData?s.putImageData(t,0,0):s.drawImage(t,0,0,t.width,t.height),i=er}return i.toDataURL(e)}static sRGBToLinear(t){if(typeof HTMLImageElement<"u"&&t instanceof HTMLImageElement||typeof HTMLCanvasElement<"u"&&t instanceof HTMLCanvasElement||typeof ImageBitmap<"u"&&t instanceof ImageBitmap){let e=bo("canvas");e.width=t.width,e.height=t.height;let i=e.getContext("2d");i.drawImage(t,0,0,t.width,t.height);let s=i.getImageData(0,0,t.width,t.height),r=s.data;for(let o=0;o<r.length;o++)r[o]=di(r[o]/255)*255;return i.putImageData(s,0,0),e}else if(t.data){let e=t.data.slice(0);for(let i=0;i<e.length;i++)e instanceof Uint8Array||e instanceof Uint8ClampedArray?e[i]=Math.floor(di(e[i]/255)*255):e[i]=di(e[i]);return{data:e,width:t.width,height:t.height}}else return Nt("ImageUtils.sRGBToLinear(): Unsupported image type. No color space conversion applied."),t}},Jv=0,Sr=class{constructor(t=null){this.isTextureSource=!0,Object.defineProperty(this,"id",{value:Jv++}),this.uuid=wi(),this.data=t,this.dataReady=!0,this.version=0}getSize(t){let e=this.data;return typeof HTMLVideoElement<"u"&&e instanceof HTMLVideoElement?t.set(e.videoWidth,e.videoHeight,0):typeof VideoFrame<"u"&&e instanceof VideoFrame?t.set(e.displayWidth,e.displayHeight,0):e!==null?t.set(e.width||0,e.height||0,e.depth||0):t.set(0,0,0),t}set needsUpdate(t){t===!0&&this.version++}toJSON(t){let e=t===void 0||typeof t=="string";if(!e&&t.images[this.uuid]!==void 0)return t.images[this.uuid];let i={uuid:this.uuid,url:""},s=this.data;if(s!==null){let r;if(Array.isArray(s)){r=[];for(let o=0,a=s.length;o<a;o++)s[o].isDataTexture?r.push(zu(s[o].image)):r.push(zu(s[o]))}else r=zu(s);i.url=r}return e||(t.images[this.uuid]=i),i}};function zu(n){return typeof HTMLImageElement<"u"&&n instanceof HTMLImageElement||typeof HTMLCanvasElement<"u"&&n instanceof HTMLCanvasElement||typeof ImageBitmap<"u"&&n instanceof ImageBitmap?kl.getDataURL(n):n.data?{data:Array.from(n.data),width:n.width,height:n.height,type:n.data.constructor.name}:(Nt("Texture: Unable to serialize Texture."),{})}var jv=0,Vu=new P,Qe=class n extends Fn{constructor(t=n.DEFAULT_IMAGE,e=n.DEFAULT_MAPPING,i=qn,s=qn,r=Ke,o=bi,a=Gn,c=rn,l=n.DEFAULT_ANISOTROPY,h=Si){super(),this.isTexture=!0,Object.defineProperty(this,"id",{value:jv++}),this.uuid=wi(),this.name="",this.source=new Sr(t),this.mipmaps=[],this.mapping=e,this.channel=0,this.wrapS=i,this.wrapT=s,this.magFilter=r,this.minFilter=o,this.anisotropy=l,this.format=a,this.internalFormat=null,this.type=c,this.offset=new ht(0,0),this.repeat=new ht(1,1),this.center=new ht(0,0),this.rotation=0,this.matrixAutoUpdate=!0,this.matrix=new Bt,this.generateMipmaps=!0,this.mipmapsAutoUpdate=!0,this.premultiplyAlpha=!1,this.flipY=!0,this.unpackAlignment=4,this.colorSpace=h,this.userData={},this.updateRanges=[],this.version=0,this.onUpdate=null,this.renderTarget=null,this.isRenderTargetTexture=!1,this.isArrayTexture=!!(t&&t.depth&&t.depth>1),this.pmremVersion=0,this.isPMREMTexture=!1,this.normalized=!1}get width(){return this.source.getSize(Vu).x}get height(){return this.source.getSize(Vu).y}get depth(){return this.source.getSize(Vu).z}get image(){return this.source.data}set image(t){this.source.data=t}updateMatrix(){this.matrix.setUvTransform(this.offset.x,this.offset.y,this.repeat.x,this.repeat.y,this.rotation,this.center.x,this.center.y)}addUpdateRange(t,e){this.updateRanges.push({start:t,count:e})}clearUpdateRanges(){this.updateRanges.length=0}clone(){return new this.constructor().copy(this)}copy(t){return this.name=t.name,this.source=t.source,this.mipmaps=t.mipmaps.slice(0),this.mapping=t.mapping,this.channel=t.channel,this.wrapS=t.wrapS,this.wrapT=t.wrapT,this.magFilter=t.magFilter,this.minFilter=t.minFilter,this.anisotropy=t.anisotropy,this.format=t.format,this.internalFormat=t.internalFormat,this.type=t.type,this.normalized=t.normalized,this.offset.copy(t.offset),this.repeat.copy(t.repeat),this.center.copy(t.center),this.rotation=t.rotation,this.matrixAutoUpdate=t.matrixAutoUpdate,this.matrix.copy(t.matrix),this.generateMipmaps=t.generateMipmaps,this.mipmapsAutoUpdate=t.mipmapsAutoUpdate,this.premultiplyAlpha=t.premultiplyAlpha,this.flipY=t.flipY,this.unpackAlignment=t.unpackAlignment,this.colorSpace=t.colorSpace,this.renderTarget=t.renderTarget,this.isRenderTargetTexture=t.isRenderTargetTexture,this.isPMREMTexture=t.isPMREMTexture,this.isArrayTexture=t.isArrayTexture,this.userData=JSON.parse(JSON.stringify(t.userData)),this.needsUpdate=!0,this}setValues(t){for(let e in t){let i=t[e];if(i===void 0){Nt(`Texture.setValues(): parameter '${e}' has value of undefined.`);continue}let s=this[e];if(s===void 0){Nt(`Texture.setValues(): property '${e}' does not exist.`);continue}s&&i&&s.isVector2&&i.isVector2||s&&i&&s.isVector3&&i.isVector3||s&&i&&s.isMatrix3&&i.isMatrix3?s.copy(i):this[e]=i}}toJSON(t){let e=t===void 0||typeof t=="string";if(!e&&t.textures[this.uuid]!==void 0)return t.textures[this.uuid];let i={metadata:{version:4.7,type:"Texture",generator:"Texture.toJSON"},uuid:this.uuid,name:this.name,image:this.source.toJSON(t).uuid,mapping:this.mapping,channel:this.channel,repeat:[this.repeat.x,this.repeat.y],offset:[this.offset.x,this.offset.y],center:[this.center.x,this.center.y],rotation:this.rotation,wrap:[this.wrapS,this.wrapT],format:this.format,internalFormat:this.internalFormat,type:this.type,normalized:this.normalized,colorSpace:this.colorSpace,minFilter:this.minFilter,magFilter:this.magFilter,anisotropy:this.anisotropy,flipY:this.flipY,generateMipmaps:this.generateMipmaps,mipmapsAutoUpdate:this.mipmapsAutoUpdate,premultiplyAlpha:this.premultiplyAlpha,unpackAlignment:this.unpackAlignment};return Object.keys(this.userData).length>0&&(i.userData=this.userData),e||(t.textures[this.uuid]=i),i}dispose(){this.dispatchEvent({type:"dispose"})}transformUv(t){if(this.mapping!==Of)return t;if(t.applyMatrix3(this.matrix),t.x<0||t.x>1)switch(this.wrapS){case Ol:t.x=t.x-Math.floor(t.x);break;case qn:t.x=t.x<0?0:1;break;case Fl:Math.abs(Math.floor(t.x)%2)===1?t.x=Math.ceil(t.x)-t.x:t.x=t.x-Math.floor(t.x);break}if(t.y<0||t.y>1)switch(this.wrapT){case Ol:t.y=t.y-Math.floor(t.y);break;case qn:t.y=t.y<0?0:1;break;case Fl:Math.abs(Math.floor(t.y)%2)===1?t.y=Math.ceil(t.y)-t.y:t.y=t.y-Math.floor(t.y);break}return this.flipY&&(t.y=1-t.y),t}set needsUpdate(t){t===!0&&(this.version++,this.source.needsUpdate=!0)}set needsPMREMUpdate(t){t===!0&&this.pmremVersion++}};Qe.DEFAULT_IMAGE=null;Qe.DEFAULT_MAPPING=Of;Qe.DEFAULT_ANISOTROPY=1;var oe=class{static{this.prototype.isVector4=!0}constructor(t=0,e=0,i=0,s=1){this.x=t,this.y=e,this.z=i,this.w=s}get width(){return this.z}set width(t){this.z=t}get height(){return this.w}set height(t){this.w=t}set(t,e,i,s){return this.x=t,this.y=e,this.z=i,this.w=s,this}setScalar(t){return this.x=t,this.y=t,this.z=t,this.w=t,this}setX(t){return this.x=t,this}setY(t){return this.y=t,this}setZ(t){return this.z=t,this}setW(t){return this.w=t,this}setComponent(t,e){switch(t){case 0:this.x=e;break;case 1:this.y=e;break;case 2:this.z=e;break;case 3:this.w=e;break;default:throw new Error("THREE.Vector4: index is out of range: "+t)}return this}getComponent(t){switch(t){case 0:return this.x;case 1:return this.y;case 2:return this.z;case 3:return this.w;default:throw new Error("THREE.Vector4: index is out of range: "+t)}}clone(){return new this.constructor(this.x,this.y,this.z,this.w)}copy(t){return this.x=t.x,this.y=t.y,this.z=t.z,this.w=t.w!==void 0?t.w:1,this}add(t){return this.x+=t.x,this.y+=t.y,this.z+=t.z,this.w+=t.w,this}addScalar(t){return this.x+=t,this.y+=t,this.z+=t,this.w+=t,this}addVectors(t,e){return this.x=t.x+e.x,this.y=t.y+e.y,this.z=t.z+e.z,this.w=t.w+e.w,this}addScaledVector(t,e){return this.x+=t.x*e,this.y+=t.y*e,this.z+=t.z*e,this.w+=t.w*e,this}sub(t){return this.x-=t.x,this.y-=t.y,this.z-=t.z,this.w-=t.w,this}subScalar(t){return this.x-=t,this.y-=t,this.z-=t,this.w-=t,this}subVectors(t,e){return this.x=t.x-e.x,this.y=t.y-e.y,this.z=t.z-e.z,this.w=t.w-e.w,this}multiply(t){return this.x*=t.x,this.y*=t.y,this.z*=t.z,this.w*=t.w,this}multiplyScalar(t){return this.x*=t,this.y*=t,this.z*=t,this.w*=t,this}applyMatrix4(t){let e=this.x,i=this.y,s=this.z,r=this.w,o=t.elements;return this.x=o[0]*e+o[4]*i+o[8]*s+o[12]*r,this.y=o[1]*e+o[5]*i+o[9]*s+o[13]*r,this.z=o[2]*e+o[6]*i+o[10]*s+o[14]*r,this.w=o[3]*e+o[7]*i+o[11]*s+o[15]*r,this}divide(t){return this.x/=t.x,this.y/=t.y,this.z/=t.z,this.w/=t.w,this}divideScalar(t){return this.multiplyScalar(1/t)}setAxisAngleFromQuaternion(t){this.w=2*Math.acos(t.w);let e=Math.sqrt(1-t.w*t.w);return e<1e-4?(this.x=1,this.y=0,this.z=0):(this.x=t.x/e,this.y=t.y/e,this.z=t.z/e),this}setAxisAngleFromRotationMatrix(t){let e,i,s,r,c=t.elements,l=c[0],h=c[4],u=c[8],f=c[1],d=c[5],m=c[9],_=c[2],p=c[6],g=c[10];if(Math.abs(h-f)<.01&&Math.abs(u-_)<.01&&Math.abs(m-p)<.01){if(Math.abs(h+f)<.1&&Math.abs(u+_)<.1&&Math.abs(m+p)<.1&&Math.abs(l+d+g-3)<.1)return this.set(1,0,0,0),this;e=Math.PI;let b=(l+1)/2,v=(d+1)/2,w=(g+1)/2,E=(h+f)/4,y=(u+_)/4,M=(m+p)/4;return b>v&&b>w?b<.01?(i=0,s=.707106781,r=.707106781):(i=Math.sqrt(b),s=E/i,r=y/i):v>w?v<.01?(i=.707106781,s=0,r=.707106781):(s=Math.sqrt(v),i=E/s,r=M/s):w<.01?(i=.707106781,s=.707106781,r=0):(r=Math.sqrt(w),i=y/r,s=M/r),this.set(i,s,r,e),this}let x=Math.sqrt((p-m)*(p-m)+(u-_)*(u-_)+(f-h)*(f-h));return Math.abs(x)<.001&&(x=1),this.x=(p-m)/x,this.y=(u-_)/x,this.z=(f-h)/x,this.w=Math.acos((l+d+g-1)/2),this}setFromMatrixPosition(t){let e=t.elements;return this.x=e[12],this.y=e[13],this.z=e[14],this.w=e[15],this}min(t){return this.x=Math.min(this.x,t.x),this.y=Math.min(this.y,t.y),this.z=Math.min(this.z,t.z),this.w=Math.min(this.w,t.w),this}max(t){return this.x=Math.max(this.x,t.x),this.y=Math.max(this.y,t.y),this.z=Math.max(this.z,t.z),this.w=Math.max(this.w,t.w),this}clamp(t,e){return this.x=Ft(this.x,t.x,e.x),this.y=Ft(this.y,t.y,e.y),this.z=Ft(this.z,t.z,e.z),this.w=Ft(this.w,t.w,e.w),this}clampScalar(t,e){return this.x=Ft(this.x,t,e),this.y=Ft(this.y,t,e),this.z=Ft(this.z,t,e),this.w=Ft(this.w,t,e),this}clampLength(t,e){let i=this.length();return this.divideScalar(i||1).multiplyScalar(Ft(i,t,e))}floor(){return this.x=Math.floor(this.x),this.y=Math.floor(this.y),this.z=Math.floor(this.z),this.w=Math.floor(this.w),this}ceil(){return this.x=Math.ceil(this.x),this.y=Math.ceil(this.y),this.z=Math.ceil(this.z),this.w=Math.ceil(this.w),this}round(){return this.x=Math.round(this.x),this.y=Math.round(this.y),this.z=Math.round(this.z),this.w=Math.round(this.w),this}roundToZero(){return this.x=Math.trunc(this.x),this.y=Math.trunc(this.y),this.z=Math.trunc(this.z),this.w=Math.trunc(this.w),this}negate(){return this.x=-this.x,this.y=-this.y,this.z=-this.z,this.w=-this.w,this}dot(t){return this.x*t.x+this.y*t.y+this.z*t.z+this.w*t.w}lengthSq(){return this.x*this.x+this.y*this.y+this.z*this.z+this.w*this.w}length(){return Math.sqrt(this.x*this.x+this.y*this.y+this.z*this.z+this.w*this.w)}manhattanLength(){return Math.abs(this.x)+Math.abs(this.y)+Math.abs(this.z)+Math.abs(this.w)}normalize(){return this.divideScalar(this.length()||1)}setLength(t){return this.normalize().multiplyScalar(t)}lerp(t,e){return this.x+=(t.x-this.x)*e,this.y+=(t.y-this.y)*e,this.z+=(t.z-this.z)*e,this.w+=(t.w-this.w)*e,this}lerpVectors(t,e,i){return this.x=t.x+(e.x-t.x)*i,this.y=t.y+(e.y-t.y)*i,this.z=t.z+(e.z-t.z)*i,this.w=t.w+(e.w-t.w)*i,this}equals(t){return t.x===this.x&&t.y===this.y&&t.z===this.z&&t.w===this.w}fromArray(t,e=0){return this.x=t[e],this.y=t[e+1],this.z=t[e+2],this.w=t[e+3],this}toArray(t=[],e=0){return t[e]=this.x,t[e+1]=this.y,t[e+2]=this.z,t[e+3]=this.w,t}fromBufferAttribute(t,e){return this.x=t.getX(e),this.y=t.getY(e),this.z=t.getZ(e),this.w=t.getW(e),this}random(){return this.x=Math.random(),this.y=Math.random(),this.z=Math.random(),this.w=Math.random(),this}*[Symbol.iterator](){yield this.x,yield this.y,yield this.z,yield this.w}},zl=class extends Fn{constructor(t=1,e=1,i={}){super(),i=Object.assign({generateMipmaps:!1,internalFormat:null,minFilter:Ke,depthBuffer:!0,stencilBuffer:!1,resolveColorBuffer:!0,resolveDepthBuffer:!0,resolveStencilBuffer:!0,storeMultisampledColorBuffer:!0,storeMultisampledDepthBuffer:!0,storeMultisampledStencilBuffer:!0,depthTexture:null,samples:0,count:1,depth:1,multiview:!1,useArrayDepthTexture:!1},i),this.isRenderTarget=!0,this.width=t,this.height=e,this.depth=i.depth,this.scissor=new oe(0,0,t,e),this.scissorTest=!1,this.viewport=new oe(0,0,t,e),this.textures=[];let s=i.count;for(let r=0;r<s;r++)this.textures[r]=new Qe({width:t,height:e,depth:i.depth}),this.textures[r].isRenderTargetTexture=!0,this.textures[r].renderTarget=this;this._setTextureOptions(i),this.depthBuffer=i.depthBuffer,this.stencilBuffer=i.stencilBuffer,this.resolveColorBuffer=i.resolveColorBuffer,this.resolveDepthBuffer=i.resolveDepthBuffer,this.resolveStencilBuffer=i.resolveStencilBuffer,this.storeMultisampledColorBuffer=i.storeMultisampledColorBuffer,this.storeMultisampledDepthBuffer=i.storeMultisampledDepthBuffer,this.storeMultisampledStencilBuffer=i.storeMultisampledStencilBuffer,this._depthTexture=null,this.depthTexture=i.depthTexture,this.samples=i.samples,this.multiview=i.multiview,this.useArrayDepthTexture=i.useArrayDepthTexture}_setTextureOptions(t={}){let e={minFilter:Ke,generateMipmaps:!1,flipY:!1,internalFormat:null};t.mapping!==void 0&&(e.mapping=t.mapping),t.wrapS!==void 0&&(e.wrapS=t.wrapS),t.wrapT!==void 0&&(e.wrapT=t.wrapT),t.wrapR!==void 0&&(e.wrapR=t.wrapR),t.magFilter!==void 0&&(e.magFilter=t.magFilter),t.minFilter!==void 0&&(e.minFilter=t.minFilter),t.format!==void 0&&(e.format=t.format),t.type!==void 0&&(e.type=t.type),t.anisotropy!==void 0&&(e.anisotropy=t.anisotropy),t.colorSpace!==void 0&&(e.colorSpace=t.colorSpace),t.flipY!==void 0&&(e.flipY=t.flipY),t.generateMipmaps!==void 0&&(e.generateMipmaps=t.generateMipmaps),t.mipmapsAutoUpdate!==void 0&&(e.mipmapsAutoUpdate=t.mipmapsAutoUpdate),t.internalFormat!==void 0&&(e.internalFormat=t.internalFormat);for(let i=0;i<this.textures.length;i++)this.textures[i].setValues(e)}get texture(){return this.textures[0]}set texture(t){this.textures[0]=t}set depthTexture(t){this._depthTexture!==null&&this._depthTexture.renderTarget===this&&(this._depthTexture.renderTarget=null),t!==null&&t.renderTarget===null&&(t.renderTarget=this),this._depthTexture=t}get depthTexture(){return this._depthTexture}setSize(t,e,i=1){if(this.width!==t||this.height!==e||this.depth!==i){this.width=t,this.height=e,this.depth=i;for(let s=0,r=this.textures.length;s<r;s++)this.textures[s].image.width=t,this.textures[s].image.height=e,this.textures[s].image.depth=i,this.textures[s].isData3DTexture!==!0&&(this.textures[s].isArrayTexture=this.textures[s].image.depth>1);this.dispose()}this.viewport.set(0,0,t,e),this.scissor.set(0,0,t,e)}clone(){return new this.constructor().copy(this)}copy(t){this.width=t.width,this.height=t.height,this.depth=t.depth,this.scissor.copy(t.scissor),this.scissorTest=t.scissorTest,this.viewport.copy(t.viewport),this.textures.length=0;for(let e=0,i=t.textures.length;e<i;e++){this.textures[e]=t.textures[e].clone(),this.textures[e].isRenderTargetTexture=!0,this.textures[e].renderTarget=this;let s=Object.assign({},t.textures[e].image);this.textures[e].source=new Sr(s)}if(this.depthBuffer=t.depthBuffer,this.stencilBuffer=t.stencilBuffer,this.resolveColorBuffer=t.resolveColorBuffer,this.resolveDepthBuffer=t.resolveDepthBuffer,this.resolveStencilBuffer=t.resolveStencilBuffer,this.storeMultisampledColorBuffer=t.storeMultisampledColorBuffer,this.storeMultisampledDepthBuffer=t.storeMultisampledDepthBuffer,this.storeMultisampledStencilBuffer=t.storeMultisampledStencilBuffer,t.depthTexture!==null)if(t.depthTexture.renderTarget===t){let e=t.depthTexture.clone();e.renderTarget=null,this.depthTexture=e}else this.depthTexture=t.depthTexture;else this.depthTexture=null;return this.samples=t.samples,this.multiview=t.multiview,this.useArrayDepthTexture=t.useArrayDepthTexture,this}dispose(){this.dispatchEvent({type:"dispose"})}},hn=class extends zl{constructor(t=1,e=1,i={}){super(t,e,i),this.isWebGLRenderTarget=!0}},So=class extends Qe{constructor(t=null,e=1,i=1,s=1){super(null),this.isDataArrayTexture=!0,this.image={data:t,width:e,height:i,depth:s},this.magFilter=Pe,this.minFilter=Pe,this.wrapR=qn,this.generateMipmaps=!1,this.flipY=!1,this.unpackAlignment=1,this.layerUpdates=new Set}copy(t){return super.copy(t),this.wrapR=t.wrapR,this}addLayerUpdate(t){this.layerUpdates.add(t)}clearLayerUpdates(){this.layerUpdates.clear()}};var Vl=class extends Qe{constructor(t=null,e=1,i=1,s=1){super(null),this.isData3DTexture=!0,this.image={data:t,width:e,height:i,depth:s},this.magFilter=Pe,this.minFilter=Pe,this.wrapR=qn,this.generateMipmaps=!1,this.flipY=!1,this.unpackAlignment=1}copy(t){return super.copy(t),this.wrapR=t.wrapR,this}};var re=class n{static{this.prototype.isMatrix4=!0}constructor(t,e,i,s,r,o,a,c,l,h,u,f,d,m,_,p){this.elements=[1,0,0,0,0,1,0,0,0,0,1,0,0,0,0,1],t!==void 0&&this.set(t,e,i,s,r,o,a,c,l,h,u,f,d,m,_,p)}set(t,e,i,s,r,o,a,c,l,h,u,f,d,m,_,p){let g=this.elements;return g[0]=t,g[4]=e,g[8]=i,g[12]=s,g[1]=r,g[5]=o,g[9]=a,g[13]=c,g[2]=l,g[6]=h,g[10]=u,g[14]=f,g[3]=d,g[7]=m,g[11]=_,g[15]=p,this}identity(){return this.set(1,0,0,0,0,1,0,0,0,0,1,0,0,0,0,1),this}clone(){return new n().fromArray(this.elements)}copy(t){let e=this.elements,i=t.elements;return e[0]=i[0],e[1]=i[1],e[2]=i[2],e[3]=i[3],e[4]=i[4],e[5]=i[5],e[6]=i[6],e[7]=i[7],e[8]=i[8],e[9]=i[9],e[10]=i[10],e[11]=i[11],e[12]=i[12],e[13]=i[13],e[14]=i[14],e[15]=i[15],this}copyPosition(t){let e=this.elements,i=t.elements;return e[12]=i[12],e[13]=i[13],e[14]=i[14],this}setFromMatrix3(t){let e=t.elements;return this.set(e[0],e[3],e[6],0,e[1],e[4],e[7],0,e[2],e[5],e[8],0,0,0,0,1),this}extractBasis(t,e,i){return this.determinantAffine()===0?(t.set(1,0,0),e.set(0,1,0),i.set(0,0,1),this):(t.setFromMatrixColumn(this,0),e.setFromMatrixColumn(this,1),i.setFromMatrixColumn(this,2),this)}makeBasis(t,e,i){return this.set(t.x,e.x,i.x,0,t.y,e.y,i.y,0,t.z,e.z,i.z,0,0,0,0,1),this}extractRotation(t){if(t.determinantAffine()===0)return this.identity();let e=this.elements,i=t.elements,s=1/nr.setFromMatrixColumn(t,0).length(),r=1/nr.setFromMatrixColumn(t,1).length(),o=1/nr.setFromMatrixColumn(t,2).length();return e[0]=i[0]*s,e[1]=i[1]*s,e[2]=i[2]*s,e[3]=0,e[4]=i[4]*r,e[5]=i[5]*r,e[6]=i[6]*r,e[7]=0,e[8]=i[8]*o,e[9]=i[9]*o,e[10]=i[10]*o,e[11]=0,e[12]=0,e[13]=0,e[14]=0,e[15]=1,this}makeRotationFromEuler(t){let e=this.elements,i=t.x,s=t.y,r=t.z,o=Math.cos(i),a=Math.sin(i),c=Math.cos(s),l=Math.sin(s),h=Math.cos(r),u=Math.sin(r);if(t.order==="XYZ"){let f=o*h,d=o*u,m=a*h,_=a*u;e[0]=c*h,e[4]=-c*u,e[8]=l,e[1]=d+m*l,e[5]=f-_*l,e[9]=-a*c,e[2]=_-f*l,e[6]=m+d*l,e[10]=o*c}else if(t.order==="YXZ"){let f=c*h,d=c*u,m=l*h,_=l*u;e[0]=f+_*a,e[4]=m*a-d,e[8]=o*l,e[1]=o*u,e[5]=o*h,e[9]=-a,e[2]=d*a-m,e[6]=_+f*a,e[10]=o*c}else if(t.order==="ZXY"){let f=c*h,d=c*u,m=l*h,_=l*u;e[0]=f-_*a,e[4]=-o*u,e[8]=m+d*a,e[1]=d+m*a,e[5]=o*h,e[9]=_-f*a,e[2]=-o*l,e[6]=a,e[10]=o*c}else if(t.order==="ZYX"){let f=o*h,d=o*u,m=a*h,_=a*u;e[0]=c*h,e[4]=m*l-d,e[8]=f*l+_,e[1]=c*u,e[5]=_*l+f,e[9]=d*l-m,e[2]=-l,e[6]=a*c,e[10]=o*c}else if(t.order==="YZX"){let f=o*c,d=o*l,m=a*c,_=a*l;e[0]=c*h,e[4]=_-f*u,e[8]=m*u+d,e[1]=u,e[5]=o*h,e[9]=-a*h,e[2]=-l*h,e[6]=d*u+m,e[10]=f-_*u}else if(t.order==="XZY"){let f=o*c,d=o*l,m=a*c,_=a*l;e[0]=c*h,e[4]=-u,e[8]=l*h,e[1]=f*u+_,e[5]=o*h,e[9]=d*u-m,e[2]=m*u-d,e[6]=a*h,e[10]=_*u+f}return e[3]=0,e[7]=0,e[11]=0,e[12]=0,e[13]=0,e[14]=0,e[15]=1,this}makeRotationFromQuaternion(t){return this.compose(Kv,t,Qv)}lookAt(t,e,i){let s=this.elements;return ln.subVectors(t,e),ln.lengthSq()===0&&(ln.z=1),ln.normalize(),Oi.crossVectors(i,ln),Oi.lengthSq()===0&&(Math.abs(i.z)===1?ln.x+=1e-4:ln.z+=1e-4,ln.normalize(),Oi.crossVectors(i,ln)),Oi.normalize(),ja.crossVectors(ln,Oi),s[0]=Oi.x,s[4]=ja.x,s[8]=ln.x,s[1]=Oi.y,s[5]=ja.y,s[9]=ln.y,s[2]=Oi.z,s[6]=ja.z,s[10]=ln.z,this}multiply(t){return this.multiplyMatrices(this,t)}premultiply(t){return this.multiplyMatrices(t,this)}multiplyMatrices(t,e){let i=t.elements,s=e.elements,r=this.elements,o=i[0],a=i[4],c=i[8],l=i[12],h=i[1],u=i[5],f=i[9],d=i[13],m=i[2],_=i[6],p=i[10],g=i[14],x=i[3],b=i[7],v=i[11],w=i[15],E=s[0],y=s[4],M=s[8],L=s[12],R=s[1],D=s[5],N=s[9],B=s[13],C=s[2],z=s[6],$=s[10],G=s[14],st=s[3],X=s[7],Z=s[11],it=s[15];return r[0]=o*E+a*R+c*C+l*st,r[4]=o*y+a*D+c*z+l*X,r[8]=o*M+a*N+c*$+l*Z,r[12]=o*L+a*B+c*G+l*it,r[1]=h*E+u*R+f*C+d*st,r[5]=h*y+u*D+f*z+d*X,r[9]=h*M+u*N+f*$+d*Z,r[13]=h*L+u*B+f*G+d*it,r[2]=m*E+_*R+p*C+g*st,r[6]=m*y+_*D+p*z+g*X,r[10]=m*M+_*N+p*$+g*Z,r[14]=m*L+_*B+p*G+g*it,r[3]=x*E+b*R+v*C+w*st,r[7]=x*y+b*D+v*z+w*X,r[11]=x*M+b*N+v*$+w*Z,r[15]=x*L+b*B+v*G+w*it,this}multiplyScalar(t){let e=this.elements;return e[0]*=t,e[4]*=t,e[8]*=t,e[12]*=t,e[1]*=t,e[5]*=t,e[9]*=t,e[13]*=t,e[2]*=t,e[6]*=t,e[10]*=t,e[14]*=t,e[3]*=t,e[7]*=t,e[11]*=t,e[15]*=t,this}determinant(){let t=this.elements,e=t[0],i=t[4],s=t[8],r=t[12],o=t[1],a=t[5],c=t[9],l=t[13],h=t[2],u=t[6],f=t[10],d=t[14],m=t[3],_=t[7],p=t[11],g=t[15],x=c*d-l*f,b=a*d-l*u,v=a*f-c*u,w=o*d-l*h,E=o*f-c*h,y=o*u-a*h;return e*(_*x-p*b+g*v)-i*(m*x-p*w+g*E)+s*(m*b-_*w+g*y)-r*(m*v-_*E+p*y)}determinantAffine(){let t=this.elements,e=t[0],i=t[4],s=t[8],r=t[1],o=t[5],a=t[9],c=t[2],l=t[6],h=t[10];return e*(o*h-a*l)-i*(r*h-a*c)+s*(r*l-o*c)}transpose(){let t=this.elements,e;return e=t[1],t[1]=t[4],t[4]=e,e=t[2],t[2]=t[8],t[8]=e,e=t[6],t[6]=t[9],t[9]=e,e=t[3],t[3]=t[12],t[12]=e,e=t[7],t[7]=t[13],t[13]=e,e=t[11],t[11]=t[14],t[14]=e,this}setPosition(t,e,i){let s=this.elements;return t.isVector3?(s[12]=t.x,s[13]=t.y,s[14]=t.z):(s[12]=t,s[13]=e,s[14]=i),this}invert(){let t=this.elements,e=t[0],i=t[1],s=t[2],r=t[3],o=t[4],a=t[5],c=t[6],l=t[7],h=t[8],u=t[9],f=t[10],d=t[11],m=t[12],_=t[13],p=t[14],g=t[15],x=e*a-i*o,b=e*c-s*o,v=e*l-r*o,w=i*c-s*a,E=i*l-r*a,y=s*l-r*c,M=h*_-u*m,L=h*p-f*m,R=h*g-d*m,D=u*p-f*_,N=u*g-d*_,B=f*g-d*p,C=x*B-b*N+v*D+w*R-E*L+y*M;if(C===0)return this.set(0,0,0,0,0,0,0,0,0,0,0,0,0,0,0,0);let z=1/C;return t[0]=(a*B-c*N+l*D)*z,t[1]=(s*N-i*B-r*D)*z,t[2]=(_*y-p*E+g*w)*z,t[3]=(f*E-u*y-d*w)*z,t[4]=(c*R-o*B-l*L)*z,t[5]=(e*B-s*R+r*L)*z,t[6]=(p*v-m*y-g*b)*z,t[7]=(h*y-f*v+d*b)*z,t[8]=(o*N-a*R+l*M)*z,t[9]=(i*R-e*N-r*M)*z,t[10]=(m*E-_*v+g*x)*z,t[11]=(u*v-h*E-d*x)*z,t[12]=(a*L-o*D-c*M)*z,t[13]=(e*D-i*L+s*M)*z,t[14]=(_*b-m*w-p*x)*z,t[15]=(h*w-u*b+f*x)*z,this}scale(t){let e=this.elements,i=t.x,s=t.y,r=t.z;return e[0]*=i,e[4]*=s,e[8]*=r,e[1]*=i,e[5]*=s,e[9]*=r,e[2]*=i,e[6]*=s,e[10]*=r,e[3]*=i,e[7]*=s,e[11]*=r,this}getMaxScaleOnAxis(){let t=this.elements,e=t[0]*t[0]+t[1]*t[1]+t[2]*t[2],i=t[4]*t[4]+t[5]*t[5]+t[6]*t[6],s=t[8]*t[8]+t[9]*t[9]+t[10]*t[10];return Math.sqrt(Math.max(e,i,s))}makeTranslation(t,e,i){return t.isVector3?this.set(1,0,0,t.x,0,1,0,t.y,0,0,1,t.z,0,0,0,1):this.set(1,0,0,t,0,1,0,e,0,0,1,i,0,0,0,1),this}makeRotationX(t){let e=Math.cos(t),i=Math.sin(t);return this.set(1,0,0,0,0,e,-i,0,0,i,e,0,0,0,0,1),this}makeRotationY(t){let e=Math.cos(t),i=Math.sin(t);return this.set(e,0,i,0,0,1,0,0,-i,0,e,0,0,0,0,1),this}makeRotationZ(t){let e=Math.cos(t),i=Math.sin(t);return this.set(e,-i,0,0,i,e,0,0,0,0,1,0,0,0,0,1),this}makeRotationAxis(t,e){let i=Math.cos(e),s=Math.sin(e),r=1-i,o=t.x,a=t.y,c=t.z,l=r*o,h=r*a;return this.set(l*o+i,l*a-s*c,l*c+s*a,0,l*a+s*c,h*a+i,h*c-s*o,0,l*c-s*a,h*c+s*o,r*c*c+i,0,0,0,0,1),this}makeScale(t,e,i){return this.set(t,0,0,0,0,e,0,0,0,0,i,0,0,0,0,1),this}makeShear(t,e,i,s,r,o){return this.set(1,i,r,0,t,1,o,0,e,s,1,0,0,0,0,1),this}compose(t,e,i){let s=this.elements,r=e._x,o=e._y,a=e._z,c=e._w,l=r+r,h=o+o,u=a+a,f=r*l,d=r*h,m=r*u,_=o*h,p=o*u,g=a*u,x=c*l,b=c*h,v=c*u,w=i.x,E=i.y,y=i.z;return s[0]=(1-(_+g))*w,s[1]=(d+v)*w,s[2]=(m-b)*w,s[3]=0,s[4]=(d-v)*E,s[5]=(1-(f+g))*E,s[6]=(p+x)*E,s[7]=0,s[8]=(m+b)*y,s[9]=(p-x)*y,s[10]=(1-(f+_))*y,s[11]=0,s[12]=t.x,s[13]=t.y,s[14]=t.z,s[15]=1,this}decompose(t,e,i){let s=this.elements;t.x=s[12],t.y=s[13],t.z=s[14];let r=this.determinantAffine();if(r===0)return i.set(1,1,1),e.identity(),this;let o=nr.set(s[0],s[1],s[2]).length(),a=nr.set(s[4],s[5],s[6]).length(),c=nr.set(s[8],s[9],s[10]).length();r<0&&(o=-o),Nn.copy(this);let l=1/o,h=1/a,u=1/c;return Nn.elements[0]*=l,Nn.elements[1]*=l,Nn.elements[2]*=l,Nn.elements[4]*=h,Nn.elements[5]*=h,Nn.elements[6]*=h,Nn.elements[8]*=u,Nn.elements[9]*=u,Nn.elements[10]*=u,e.setFromRotationMatrix(Nn),i.x=o,i.y=a,i.z=c,this}makePerspective(t,e,i,s,r,o,a=wn,c=!1){let l=this.elements,h=2*r/(e-t),u=2*r/(i-s),f=(e+t)/(e-t),d=(i+s)/(i-s),m,_;if(c)m=r/(o-r),_=o*r/(o-r);else if(a===wn)m=-(o+r)/(o-r),_=-2*o*r/(o-r);else if(a===vr)m=-o/(o-r),_=-o*r/(o-r);else throw new Error("THREE.Matrix4.makePerspective(): Invalid coordinate system: "+a);return l[0]=h,l[4]=0,l[8]=f,l[12]=0,l[1]=0,l[5]=u,l[9]=d,l[13]=0,l[2]=0,l[6]=0,l[10]=m,l[14]=_,l[3]=0,l[7]=0,l[11]=-1,l[15]=0,this}makeOrthographic(t,e,i,s,r,o,a=wn,c=!1){let l=this.elements,h=2/(e-t),u=2/(i-s),f=-(e+t)/(e-t),d=-(i+s)/(i-s),m,_;if(c)m=1/(o-r),_=o/(o-r);else if(a===wn)m=-2/(o-r),_=-(o+r)/(o-r);else if(a===vr)m=-1/(o-r),_=-r/(o-r);else throw new Error("THREE.Matrix4.makeOrthographic(): Invalid coordinate system: "+a);return l[0]=h,l[4]=0,l[8]=0,l[12]=f,l[1]=0,l[5]=u,l[9]=0,l[13]=d,l[2]=0,l[6]=0,l[10]=m,l[14]=_,l[3]=0,l[7]=0,l[11]=0,l[15]=1,this}equals(t){let e=this.elements,i=t.elements;for(let s=0;s<16;s++)if(e[s]!==i[s])return!1;return!0}fromArray(t,e=0){for(let i=0;i<16;i++)this.elements[i]=t[i+e];return this}toArray(t=[],e=0){let i=this.elements;return t[e]=i[0],t[e+1]=i[1],t[e+2]=i[2],t[e+3]=i[3],t[e+4]=i[4],t[e+5]=i[5],t[e+6]=i[6],t[e+7]=i[7],t[e+8]=i[8],t[e+9]=i[9],t[e+10]=i[10],t[e+11]=i[11],t[e+12]=i[12],t[e+13]=i[13],t[e+14]=i[14],t[e+15]=i[15],t}},nr=new P,Nn=new re,Kv=new P(0,0,0),Qv=new P(1,1,1),Oi=new P,ja=new P,ln=new P,mg=new re,gg=new Ne,mi=class n{constructor(t=0,e=0,i=0,s=n.DEFAULT_ORDER){this.isEuler=!0,this._x=t,this._y=e,this._z=i,this._order=s}get x(){return this._x}set x(t){this._x=t,this._onChangeCallback()}get y(){return this._y}set y(t){this._y=t,this._onChangeCallback()}get z(){return this._z}set z(t){this._z=t,this._onChangeCallback()}get order(){return this._order}set order(t){this._order=t,this._onChangeCallback()}set(t,e,i,s=this._order){return this._x=t,this._y=e,this._z=i,this._order=s,this._onChangeCallback(),this}clone(){return new this.constructor(this._x,this._y,this._z,this._order)}copy(t){return this._x=t._x,this._y=t._y,this._z=t._z,this._order=t._order,this._onChangeCallback(),this}setFromRotationMatrix(t,e=this._order,i=!0){let s=t.elements,r=s[0],o=s[4],a=s[8],c=s[1],l=s[5],h=s[9],u=s[2],f=s[6],d=s[10];switch(e){case"XYZ":this._y=Math.asin(Ft(a,-1,1)),Math.abs(a)<.9999999?(this._x=Math.atan2(-h,d),this._z=Math.atan2(-o,r)):(this._x=Math.atan2(f,l),this._z=0);break;case"YXZ":this._x=Math.asin(-Ft(h,-1,1)),Math.abs(h)<.9999999?(this._y=Math.atan2(a,d),this._z=Math.atan2(c,l)):(this._y=Math.atan2(-u,r),this._z=0);break;case"ZXY":this._x=Math.asin(Ft(f,-1,1)),Math.abs(f)<.9999999?(this._y=Math.atan2(-u,d),this._z=Math.atan2(-o,l)):(this._y=0,this._z=Math.atan2(c,r));break;case"ZYX":this._y=Math.asin(-Ft(u,-1,1)),Math.abs(u)<.9999999?(this._x=Math.atan2(f,d),this._z=Math.atan2(c,r)):(this._x=0,this._z=Math.atan2(-o,l));break;case"YZX":this._z=Math.asin(Ft(c,-1,1)),Math.abs(c)<.9999999?(this._x=Math.atan2(-h,l),this._y=Math.atan2(-u,r)):(this._x=0,this._y=Math.atan2(a,d));break;case"XZY":this._z=Math.asin(-Ft(o,-1,1)),Math.abs(o)<.9999999?(this._x=Math.atan2(f,l),this._y=Math.atan2(a,r)):(this._x=Math.atan2(-h,d),this._y=0);break;default:Nt("Euler: .setFromRotationMatrix() encountered an unknown order: "+e)}return this._order=e,i===!0&&this._onChangeCallback(),this}setFromQuaternion(t,e,i){return mg.makeRotationFromQuaternion(t),this.setFromRotationMatrix(mg,e,i)}setFromVector3(t,e=this._order){return this.set(t.x,t.y,t.z,e)}reorder(t){return gg.setFromEuler(this),this.setFromQuaternion(gg,t)}equals(t){return t._x===this._x&&t._y===this._y&&t._z===this._z&&t._order===this._order}fromArray(t){return this._x=t[0],this._y=t[1],this._z=t[2],t[3]!==void 0&&(this._order=t[3]),this._onChangeCallback(),this}toArray(t=[],e=0){return t[e]=this._x,t[e+1]=this._y,t[e+2]=this._z,t[e+3]=this._order,t}_onChange(t){return this._onChangeCallback=t,this}_onChangeCallback(){}*[Symbol.iterator](){yield this._x,yield this._y,yield this._z,yield this._order}};mi.DEFAULT_ORDER="XYZ";var wr=class{constructor(){this.mask=1}set(t){this.mask=(1<<t|0)>>>0}enable(t){this.mask|=1<<t|0}enableAll(){this.mask=-1}toggle(t){this.mask^=1<<t|0}disable(t){this.mask&=~(1<<t|0)}disableAll(){this.mask=0}test(t){return(this.mask&t.mask)!==0}isEnabled(t){return(this.mask&(1<<t|0))!==0}},tb=0,_g=new P,ir=new Ne,ai=new re,Ka=new P,ao=new P,eb=new P,nb=new Ne,xg=new P(1,0,0),yg=new P(0,1,0),vg=new P(0,0,1),bg={type:"added"},ib={type:"removed"},sr={type:"childadded",child:null},Gu={type:"childremoved",child:null},De=class n extends Fn{constructor(){super(),this.isObject3D=!0,Object.defineProperty(this,"id",{value:tb++}),this.uuid=wi(),this.name="",this.type="Object3D",this.parent=null,this.children=[],this.up=n.DEFAULT_UP.clone();let t=new P,e=new mi,i=new Ne,s=new P(1,1,1);function r(){i.setFromEuler(e,!1)}function o(){e.setFromQuaternion(i,void 0,!1)}e._onChange(r),i._onChange(o),Object.defineProperties(this,{position:{configurable:!0,enumerable:!0,value:t},rotation:{configurable:!0,enumerable:!0,value:e},quaternion:{configurable:!0,enumerable:!0,value:i},scale:{configurable:!0,enumerable:!0,value:s},modelViewMatrix:{value:new re},normalMatrix:{value:new Bt}}),this.matrix=new re,this.matrixWorld=new re,this.matrixAutoUpdate=n.DEFAULT_MATRIX_AUTO_UPDATE,this.matrixWorldAutoUpdate=n.DEFAULT_MATRIX_WORLD_AUTO_UPDATE,this.matrixWorldNeedsUpdate=!1,this.layers=new wr,this.visible=!0,this.castShadow=!1,this.receiveShadow=!1,this.frustumCulled=!0,this.renderOrder=0,this.animations=[],this.customDepthMaterial=void 0,this.customDistanceMaterial=void 0,this.static=!1,this.userData={},this.pivot=null}onBeforeShadow(){}onAfterShadow(){}onBeforeRender(){}onAfterRender(){}applyMatrix4(t){this.matrixAutoUpdate&&this.updateMatrix(),this.matrix.premultiply(t),this.matrix.decompose(this.position,this.quaternion,this.scale),this.pivot!==null&&this.position.copy(this.pivot).applyMatrix4(this.matrix).sub(this.pivot)}applyQuaternion(t){return this.quaternion.premultiply(t),this}setRotationFromAxisAngle(t,e){this.quaternion.setFromAxisAngle(t,e)}setRotationFromEuler(t){this.quaternion.setFromEuler(t,!0)}setRotationFromMatrix(t){this.quaternion.setFromRotationMatrix(t)}setRotationFromQuaternion(t){this.quaternion.copy(t)}rotateOnAxis(t,e){return ir.setFromAxisAngle(t,e),this.quaternion.multiply(ir),this}rotateOnWorldAxis(t,e){return ir.setFromAxisAngle(t,e),this.quaternion.premultiply(ir),this}rotateX(t){return this.rotateOnAxis(xg,t)}rotateY(t){return this.rotateOnAxis(yg,t)}rotateZ(t){return this.rotateOnAxis(vg,t)}translateOnAxis(t,e){return _g.copy(t).applyQuaternion(this.quaternion),this.position.add(_g.multiplyScalar(e)),this}translateX(t){return this.translateOnAxis(xg,t)}translateY(t){return this.translateOnAxis(yg,t)}translateZ(t){return this.translateOnAxis(vg,t)}localToWorld(t){return this.updateWorldMatrix(!0,!1),t.applyMatrix4(this.matrixWorld)}worldToLocal(t){return this.updateWorldMatrix(!0,!1),t.applyMatrix4(ai.copy(this.matrixWorld).invert())}lookAt(t,e,i){t.isVector3?Ka.copy(t):Ka.set(t,e,i);let s=this.parent;this.updateWorldMatrix(!0,!1),ao.setFromMatrixPosition(this.matrixWorld),this.isCamera||this.isLight?ai.lookAt(ao,Ka,this.up):ai.lookAt(Ka,ao,this.up),this.quaternion.setFromRotationMatrix(ai),s&&(ai.extractRotation(s.matrixWorld),ir.setFromRotationMatrix(ai),this.quaternion.premultiply(ir.invert()))}add(t){if(arguments.length>1){for(let e=0;e<arguments.length;e++)this.add(arguments[e]);return this}return t===this?(Ot("Object3D.add: object can't be added as a child of itself.",t),this):(t&&t.isObject3D?(t.removeFromParent(),t.parent=this,this.children.push(t),t.dispatchEvent(bg),sr.child=t,this.dispatchEvent(sr),sr.child=null):Ot("Object3D.add: object not an instance of THREE.Object3D.",t),this)}remove(t){if(arguments.length>1){for(let i=0;i<arguments.length;i++)this.remove(arguments[i]);return this}let e=this.children.indexOf(t);return e!==-1&&(t.parent=null,this.children.splice(e,1),t.dispatchEvent(ib),Gu.child=t,this.dispatchEvent(Gu),Gu.child=null),this}removeFromParent(){let t=this.parent;return t!==null&&t.remove(this),this}clear(){return this.remove(...this.children)}attach(t){return this.updateWorldMatrix(!0,!1),ai.copy(this.matrixWorld).invert(),t.parent!==null&&(t.parent.updateWorldMatrix(!0,!1),ai.multiply(t.parent.matrixWorld)),t.applyMatrix4(ai),t.removeFromParent(),t.parent=this,this.children.push(t),t.updateWorldMatrix(!1,!0),t.dispatchEvent(bg),sr.child=t,this.dispatchEvent(sr),sr.child=null,this}getObjectById(t){return this.getObjectByProperty("id",t)}getObjectByName(t){return this.getObjectByProperty("name",t)}getObjectByProperty(t,e){if(this[t]===e)return this;for(let i=0,s=this.children.length;i<s;i++){let o=this.children[i].getObjectByProperty(t,e);if(o!==void 0)return o}}getObjectsByProperty(t,e,i=[]){this[t]===e&&i.push(this);let s=this.children;for(let r=0,o=s.length;r<o;r++)s[r].getObjectsByProperty(t,e,i);return i}getWorldPosition(t){return this.updateWorldMatrix(!0,!1),t.setFromMatrixPosition(this.matrixWorld)}getWorldQuaternion(t){return this.updateWorldMatrix(!0,!1),this.matrixWorld.decompose(ao,t,eb),t}getWorldScale(t){return this.updateWorldMatrix(!0,!1),this.matrixWorld.decompose(ao,nb,t),t}getWorldDirection(t){this.updateWorldMatrix(!0,!1);let e=this.matrixWorld.elements;return t.set(e[8],e[9],e[10]).normalize()}raycast(){}intersectsFrustum(){return!0}traverse(t){t(this);let e=this.children;for(let i=0,s=e.length;i<s;i++)e[i].traverse(t)}traverseVisible(t){if(this.visible===!1)return;t(this);let e=this.children;for(let i=0,s=e.length;i<s;i++)e[i].traverseVisible(t)}traverseAncestors(t){let e=this.parent;e!==null&&(t(e),e.traverseAncestors(t))}updateMatrix(){this.matrix.compose(this.position,this.quaternion,this.scale);let t=this.pivot;if(t!==null){let e=t.x,i=t.y,s=t.z,r=this.matrix.elements;r[12]+=e-r[0]*e-r[4]*i-r[8]*s,r[13]+=i-r[1]*e-r[5]*i-r[9]*s,r[14]+=s-r[2]*e-r[6]*i-r[10]*s}this.matrixWorldNeedsUpdate=!0}updateMatrixWorld(t){this.matrixAutoUpdate&&this.updateMatrix(),(this.matrixWorldNeedsUpdate||t)&&(this.matrixWorldAutoUpdate===!0&&(this.parent===null?this.matrixWorld.copy(this.matrix):this.matrixWorld.multiplyMatrices(this.parent.matrixWorld,this.matrix)),this.matrixWorldNeedsUpdate=!1,t=!0);let e=this.children;for(let i=0,s=e.length;i<s;i++)e[i].updateMatrixWorld(t)}updateWorldMatrix(t,e,i=!1){let s=this.parent;if(t===!0&&s!==null&&s.updateWorldMatrix(!0,!1),this.matrixAutoUpdate&&this.updateMatrix(),(this.matrixWorldNeedsUpdate||i)&&(this.matrixWorldAutoUpdate===!0&&(this.parent===null?this.matrixWorld.copy(this.matrix):this.matrixWorld.multiplyMatrices(this.parent.matrixWorld,this.matrix)),this.matrixWorldNeedsUpdate=!1,i=!0),e===!0){let r=this.children;for(let o=0,a=r.length;o<a;o++)r[o].updateWorldMatrix(!1,!0,i)}}toJSON(t){let e=t===void 0||typeof t=="string",i={};e&&(t={geometries:{},materials:{},textures:{},images:{},shapes:{},skeletons:{},animations:{},nodes:{}},i.metadata={version:4.7,type:"Object",generator:"Object3D.toJSON"});let s={};s.uuid=this.uuid,s.type=this.type,s.name=this.name,s.castShadow=this.castShadow,s.receiveShadow=this.receiveShadow,s.visible=this.visible,s.frustumCulled=this.frustumCulled,s.renderOrder=this.renderOrder,s.static=this.static,s.matrixAutoUpdate=this.matrixAutoUpdate,Object.keys(this.userData).length>0&&(s.userData=this.userData),s.layers=this.layers.mask,s.matrix=this.matrix.toArray(),s.up=this.up.toArray(),this.pivot!==null&&(s.pivot=this.pivot.toArray()),this.morphTargetDictionary!==void 0&&(s.morphTargetDictionary=Object.assign({},this.morphTargetDictionary)),this.morphTargetInfluences!==void 0&&(s.morphTargetInfluences=this.morphTargetInfluences.slice()),this.isInstancedMesh&&(s.type="InstancedMesh",s.count=this.count,s.instanceMatrix=this.instanceMatrix.toJSON(),this.instanceColor!==null&&(s.instanceColor=this.instanceColor.toJSON())),this.isBatchedMesh&&(s.type="BatchedMesh",s.perObjectFrustumCulled=this.perObjectFrustumCulled,s.sortObjects=this.sortObjects,s.drawRanges=this._drawRanges,s.reservedRanges=this._reservedRanges,s.geometryInfo=this._geometryInfo.map(a=>({...a,boundingBox:a.boundingBox?a.boundingBox.toJSON():void 0,boundingSphere:a.boundingSphere?a.boundingSphere.toJSON():void 0})),s.instanceInfo=this._instanceInfo.map(a=>({...a})),s.availableInstanceIds=this._availableInstanceIds.slice(),s.availableGeometryIds=this._availableGeometryIds.slice(),s.nextIndexStart=this._nextIndexStart,s.nextVertexStart=this._nextVertexStart,s.geometryCount=this._geometryCount,s.maxInstanceCount=this._maxInstanceCount,s.maxVertexCount=this._maxVertexCount,s.maxIndexCount=this._maxIndexCount,s.geometryInitialized=this._geometryInitialized,s.matricesTexture=this._matricesTexture.toJSON(t),s.indirectTexture=this._indirectTexture.toJSON(t),this._colorsTexture!==null&&(s.colorsTexture=this._colorsTexture.toJSON(t)),this.boundingSphere!==null&&(s.boundingSphere=this.boundingSphere.toJSON()),this.boundingBox!==null&&(s.boundingBox=this.boundingBox.toJSON()));function r(a,c){return a[c.uuid]===void 0&&(a[c.uuid]=c.toJSON(t)),c.uuid}if(this.isScene)this.background&&(this.background.isColor?s.background=this.background.toJSON():this.background.isTexture&&(s.background=this.background.toJSON(t).uuid)),this.environment&&this.environment.isTexture&&this.environment.isRenderTargetTexture!==!0&&(s.environment=this.environment.toJSON(t).uuid);else if(this.isMesh||this.isLine||this.isPoints){s.geometry=r(t.geometries,this.geometry);let a=this.geometry.parameters;if(a!==void 0&&a.shapes!==void 0){let c=a.shapes;if(Array.isArray(c))for(let l=0,h=c.length;l<h;l++){let u=c[l];r(t.shapes,u)}else r(t.shapes,c)}}if(this.isSkinnedMesh&&(s.bindMode=this.bindMode,s.bindMatrix=this.bindMatrix.toArray(),this.skeleton!==void 0&&(r(t.skeletons,this.skeleton),s.skeleton=this.skeleton.uuid)),this.material!==void 0)if(Array.isArray(this.material)){let a=[];for(let c=0,l=this.material.length;c<l;c++)a.push(r(t.materials,this.material[c]));s.material=a}else s.material=r(t.materials,this.material);if(this.children.length>0){s.children=[];for(let a=0;a<this.children.length;a++)s.children.push(this.children[a].toJSON(t).object)}if(this.animations.length>0){s.animations=[];for(let a=0;a<this.animations.length;a++){let c=this.animations[a];s.animations.push(r(t.animations,c))}}if(e){let a=o(t.geometries),c=o(t.materials),l=o(t.textures),h=o(t.images),u=o(t.shapes),f=o(t.skeletons),d=o(t.animations),m=o(t.nodes);a.length>0&&(i.geometries=a),c.length>0&&(i.materials=c),l.length>0&&(i.textures=l),h.length>0&&(i.images=h),u.length>0&&(i.shapes=u),f.length>0&&(i.skeletons=f),d.length>0&&(i.animations=d),m.length>0&&(i.nodes=m)}return i.object=s,i;function o(a){let c=[];for(let l in a){let h=a[l];delete h.metadata,c.push(h)}return c}}clone(t){return new this.constructor().copy(this,t)}copy(t,e=!0){if(this.name=t.name,this.up.copy(t.up),this.position.copy(t.position),this.rotation.order=t.rotation.order,this.quaternion.copy(t.quaternion),this.scale.copy(t.scale),this.pivot=t.pivot!==null?t.pivot.clone():null,this.matrix.copy(t.matrix),this.matrixWorld.copy(t.matrixWorld),this.matrixAutoUpdate=t.matrixAutoUpdate,this.matrixWorldAutoUpdate=t.matrixWorldAutoUpdate,this.matrixWorldNeedsUpdate=t.matrixWorldNeedsUpdate,this.layers.mask=t.layers.mask,this.visible=t.visible,this.castShadow=t.castShadow,this.receiveShadow=t.receiveShadow,this.frustumCulled=t.frustumCulled,this.renderOrder=t.renderOrder,this.static=t.static,this.animations=t.animations.slice(),this.userData=JSON.parse(JSON.stringify(t.userData)),e===!0)for(let i=0;i<t.children.length;i++){let s=t.children[i];this.add(s.clone())}return this}dispose(){this.dispatchEvent({type:"dispose"})}};De.DEFAULT_UP=new P(0,1,0);De.DEFAULT_MATRIX_AUTO_UPDATE=!0;De.DEFAULT_MATRIX_WORLD_AUTO_UPDATE=!0;var Le=class extends De{constructor(){super(),this.isGroup=!0,this.type="Group"}},sb={type:"move"},Ar=class{constructor(){this._targetRay=null,this._grip=null,this._hand=null}getHandSpace(){return this._hand===null&&(this._hand=new Le,this._hand.matrixAutoUpdate=!1,this._hand.visible=!1,this._hand.joints={},this._hand.inputState={pinching:!1}),this._hand}getTargetRaySpace(){return this._targetRay===null&&(this._targetRay=new Le,this._targetRay.matrixAutoUpdate=!1,this._targetRay.visible=!1,this._targetRay.hasLinearVelocity=!1,this._targetRay.linearVelocity=new P,this._targetRay.hasAngularVelocity=!1,this._targetRay.angularVelocity=new P),this._targetRay}getGripSpace(){return this._grip===null&&(this._grip=new Le,this._grip.matrixAutoUpdate=!1,this._grip.visible=!1,this._grip.hasLinearVelocity=!1,this._grip.linearVelocity=new P,this._grip.hasAngularVelocity=!1,this._grip.angularVelocity=new P,this._grip.eventsEnabled=!1),this._grip}dispatchEvent(t){return this._targetRay!==null&&this._targetRay.dispatchEvent(t),this._grip!==null&&this._grip.dispatchEvent(t),this._hand!==null&&this._hand.dispatchEvent(t),this}connect(t){if(t&&t.hand){let e=this._hand;if(e)for(let i of t.hand.values())this._getHandJoint(e,i)}return this.dispatchEvent({type:"connected",data:t}),this}disconnect(t){return this.dispatchEvent({type:"disconnected",data:t}),this._targetRay!==null&&(this._targetRay.visible=!1),this._grip!==null&&(this._grip.visible=!1),this._hand!==null&&(this._hand.visible=!1),this}update(t,e,i){let s=null,r=null,o=null,a=this._targetRay,c=this._grip,l=this._hand;if(t&&e.session.visibilityState!=="visible-blurred"){if(l&&t.hand){o=!0;for(let _ of t.hand.values()){let p=e.getJointPose(_,i),g=this._getHandJoint(l,_);p!==null&&(g.matrix.fromArray(p.transform.matrix),g.matrix.decompose(g.position,g.quaternion,g.scale),g.matrixWorldNeedsUpdate=!0,g.jointRadius=p.radius),g.visible=p!==null}let h=l.joints["index-finger-tip"],u=l.joints["thumb-tip"],f=h.position.distanceTo(u.position),d=.02,m=.005;l.inputState.pinching&&f>d+m?(l.inputState.pinching=!1,this.dispatchEvent({type:"pinchend",handedness:t.handedness,target:this})):!l.inputState.pinching&&f<=d-m&&(l.inputState.pinching=!0,this.dispatchEvent({type:"pinchstart",handedness:t.handedness,target:this}))}else c!==null&&t.gripSpace&&(r=e.getPose(t.gripSpace,i),r!==null&&(c.matrix.fromArray(r.transform.matrix),c.matrix.decompose(c.position,c.quaternion,c.scale),c.matrixWorldNeedsUpdate=!0,r.linearVelocity?(c.hasLinearVelocity=!0,c.linearVelocity.copy(r.linearVelocity)):c.hasLinearVelocity=!1,r.angularVelocity?(c.hasAngularVelocity=!0,c.angularVelocity.copy(r.angularVelocity)):c.hasAngularVelocity=!1,c.eventsEnabled&&c.dispatchEvent({type:"gripUpdated",data:t,target:this})));a!==null&&(s=e.getPose(t.targetRaySpace,i),s===null&&r!==null&&(s=r),s!==null&&(a.matrix.fromArray(s.transform.matrix),a.matrix.decompose(a.position,a.quaternion,a.scale),a.matrixWorldNeedsUpdate=!0,s.linearVelocity?(a.hasLinearVelocity=!0,a.linearVelocity.copy(s.linearVelocity)):a.hasLinearVelocity=!1,s.angularVelocity?(a.hasAngularVelocity=!0,a.angularVelocity.copy(s.angularVelocity)):a.hasAngularVelocity=!1,this.dispatchEvent(sb)))}return a!==null&&(a.visible=s!==null),c!==null&&(c.visible=r!==null),l!==null&&(l.visible=o!==null),this}_getHandJoint(t,e){if(t.joints[e.jointName]===void 0){let i=new Le;i.matrixAutoUpdate=!1,i.visible=!1,t.joints[e.jointName]=i,t.add(i)}return t.joints[e.jointName]}},D0={aliceblue:15792383,antiquewhite:16444375,aqua:65535,aquamarine:8388564,azure:15794175,beige:16119260,bisque:16770244,black:0,blanchedalmond:16772045,blue:255,blueviolet:9055202,brown:10824234,burlywood:14596231,cadetblue:6266528,chartreuse:8388352,chocolate:13789470,coral:16744272,cornflowerblue:6591981,cornsilk:16775388,crimson:14423100,cyan:65535,darkblue:139,darkcyan:35723,darkgoldenrod:12092939,darkgray:11119017,darkgreen:25600,darkgrey:11119017,darkkhaki:12433259,darkmagenta:9109643,darkolivegreen:5597999,darkorange:16747520,darkorchid:10040012,darkred:9109504,darksalmon:15308410,darkseagreen:9419919,darkslateblue:4734347,darkslategray:3100495,darkslategrey:3100495,darkturquoise:52945,darkviolet:9699539,deeppink:16716947,deepskyblue:49151,dimgray:6908265,dimgrey:6908265,dodgerblue:2003199,firebrick:11674146,floralwhite:16775920,forestgreen:2263842,fuchsia:16711935,gainsboro:14474460,ghostwhite:16316671,gold:16766720,goldenrod:14329120,gray:8421504,green:32768,greenyellow:11403055,grey:8421504,honeydew:15794160,hotpink:16738740,indianred:13458524,indigo:4915330,ivory:16777200,khaki:15787660,lavender:15132410,lavenderblush:16773365,lawngreen:8190976,lemonchiffon:16775885,lightblue:11393254,lightcoral:15761536,lightcyan:14745599,lightgoldenrodyellow:16448210,lightgray:13882323,lightgreen:9498256,lightgrey:13882323,lightpink:16758465,lightsalmon:16752762,lightseagreen:2142890,lightskyblue:8900346,lightslategray:7833753,lightslategrey:7833753,lightsteelblue:11584734,lightyellow:16777184,lime:65280,limegreen:3329330,linen:16445670,magenta:16711935,maroon:8388608,mediumaquamarine:6737322,mediumblue:205,mediumorchid:12211667,mediumpurple:9662683,mediumseagreen:3978097,mediumslateblue:8087790,mediumspringgreen:64154,mediumturquoise:4772300,mediumvioletred:13047173,midnightblue:1644912,mintcream:16121850,mistyrose:16770273,moccasin:16770229,navajowhite:16768685,navy:128,oldlace:16643558,olive:8421376,olivedrab:7048739,orange:16753920,orangered:16729344,orchid:14315734,palegoldenrod:15657130,palegreen:10025880,paleturquoise:11529966,palevioletred:14381203,papayawhip:16773077,peachpuff:16767673,peru:13468991,pink:16761035,plum:14524637,powderblue:11591910,purple:8388736,rebeccapurple:6697881,red:16711680,rosybrown:12357519,royalblue:4286945,saddlebrown:9127187,salmon:16416882,sandybrown:16032864,seagreen:3050327,seashell:16774638,sienna:10506797,silver:12632256,skyblue:8900331,slateblue:6970061,slategray:7372944,slategrey:7372944,snow:16775930,springgreen:65407,steelblue:4620980,tan:13808780,teal:32896,thistle:14204888,tomato:16737095,turquoise:4251856,violet:15631086,wheat:16113331,white:16777215,whitesmoke:16119285,yellow:16776960,yellowgreen:10145074},Fi={h:0,s:0,l:0},Qa={h:0,s:0,l:0};function Hu(n,t,e){return e<0&&(e+=1),e>1&&(e-=1),e<1/6?n+(t-n)*6*e:e<1/2?t:e<2/3?n+(t-n)*6*(2/3-e):n}var Gt=class{constructor(t,e,i){return this.isColor=!0,this.r=1,this.g=1,this.b=1,this.set(t,e,i)}set(t,e,i){if(e===void 0&&i===void 0){let s=t;s&&s.isColor?this.copy(s):typeof s=="number"?this.setHex(s):typeof s=="string"&&this.setStyle(s)}else this.setRGB(t,e,i);return this}setScalar(t){return this.r=t,this.g=t,this.b=t,this}setHex(t,e=Ze){return t=Math.floor(t),this.r=(t>>16&255)/255,this.g=(t>>8&255)/255,this.b=(t&255)/255,Jt.colorSpaceToWorking(this,e),this}setRGB(t,e,i,s=Jt.workingColorSpace){return this.r=t,this.g=e,this.b=i,Jt.colorSpaceToWorking(this,s),this}setHSL(t,e,i,s=Jt.workingColorSpace){if(t=Zf(t,1),e=Ft(e,0,1),i=Ft(i,0,1),e===0)this.r=this.g=this.b=i;else{let r=i<=.5?i*(1+e):i+e-i*e,o=2*i-r;this.r=Hu(o,r,t+1/3),this.g=Hu(o,r,t),this.b=Hu(o,r,t-1/3)}return Jt.colorSpaceToWorking(this,s),this}setStyle(t,e=Ze){function i(r){r!==void 0&&parseFloat(r)<1&&Nt("Color: Alpha component of "+t+" will be ignored.")}let s;if(s=/^(\w+)\(([^\)]*)\)/.exec(t)){let r,o=s[1],a=s[2];switch(o){case"rgb":case"rgba":if(r=/^\s*(\d+)\s*,\s*(\d+)\s*,\s*(\d+)\s*(?:,\s*(\d+(?:\.\d+)?|\.\d+)\s*)?$/.exec(a))return i(r[4]),this.setRGB(Math.min(255,parseInt(r[1],10))/255,Math.min(255,parseInt(r[2],10))/255,Math.min(255,parseInt(r[3],10))/255,e);if(r=/^\s*(\d+(?:\.\d+)?|\.\d+)\%\s*,\s*(\d+(?:\.\d+)?|\.\d+)\%\s*,\s*(\d+(?:\.\d+)?|\.\d+)\%\s*(?:,\s*(\d+(?:\.\d+)?|\.\d+)\s*)?$/.exec(a))return i(r[4]),this.setRGB(Math.min(100,parseFloat(r[1]))/100,Math.min(100,parseFloat(r[2]))/100,Math.min(100,parseFloat(r[3]))/100,e);break;case"hsl":case"hsla":if(r=/^\s*([+-]?(?:\d+(?:\.\d+)?|\.\d+))\s*,\s*(\d+(?:\.\d+)?|\.\d+)\%\s*,\s*(\d+(?:\.\d+)?|\.\d+)\%\s*(?:,\s*(\d+(?:\.\d+)?|\.\d+)\s*)?$/.exec(a))return i(r[4]),this.setHSL(parseFloat(r[1])/360,parseFloat(r[2])/100,parseFloat(r[3])/100,e);break;default:Nt("Color: Unknown color model "+t)}}else if(s=/^\#([A-Fa-f\d]+)$/.exec(t)){let r=s[1],o=r.length;if(o===3)return this.setRGB(parseInt(r.charAt(0),16)/15,parseInt(r.charAt(1),16)/15,parseInt(r.charAt(2),16)/15,e);if(o===6)return this.setHex(parseInt(r,16),e);Nt("Color: Invalid hex color "+t)}else if(t&&t.length>0)return this.setColorName(t,e);return this}setColorName(t,e=Ze){let i=D0[t.toLowerCase()];return i!==void 0?this.setHex(i,e):Nt("Color: Unknown color "+t),this}clone(){return new this.constructor(this.r,this.g,this.b)}copy(t){return this.r=t.r,this.g=t.g,this.b=t.b,this}copySRGBToLinear(t){return this.r=di(t.r),this.g=di(t.g),this.b=di(t.b),this}copyLinearToSRGB(t){return this.r=_r(t.r),this.g=_r(t.g),this.b=_r(t.b),this}convertSRGBToLinear(){return this.copySRGBToLinear(this),this}convertLinearToSRGB(){return this.copyLinearToSRGB(this),this}getHex(t=Ze){return Jt.workingToColorSpace(Xe.copy(this),t),Math.round(Ft(Xe.r*255,0,255))*65536+Math.round(Ft(Xe.g*255,0,255))*256+Math.round(Ft(Xe.b*255,0,255))}getHexString(t=Ze){return("000000"+this.getHex(t).toString(16)).slice(-6)}getHSL(t,e=Jt.workingColorSpace){Jt.workingToColorSpace(Xe.copy(this),e);let i=Xe.r,s=Xe.g,r=Xe.b,o=Math.max(i,s,r),a=Math.min(i,s,r),c,l,h=(a+o)/2;if(a===o)c=0,l=0;else{let u=o-a;switch(l=h<=.5?u/(o+a):u/(2-o-a),o){case i:c=(s-r)/u+(s<r?6:0);break;case s:c=(r-i)/u+2;break;case r:c=(i-s)/u+4;break}c/=6}return t.h=c,t.s=l,t.l=h,t}getRGB(t,e=Jt.workingColorSpace){return Jt.workingToColorSpace(Xe.copy(this),e),t.r=Xe.r,t.g=Xe.g,t.b=Xe.b,t}getStyle(t=Ze){Jt.workingToColorSpace(Xe.copy(this),t);let e=Xe.r,i=Xe.g,s=Xe.b;return t!==Ze?`color(${t} ${e.toFixed(3)} ${i.toFixed(3)} ${s.toFixed(3)})`:`rgb(${Math.round(e*255)},${Math.round(i*255)},${Math.round(s*255)})`}offsetHSL(t,e,i){return this.getHSL(Fi),this.setHSL(Fi.h+t,Fi.s+e,Fi.l+i)}add(t){return this.r+=t.r,this.g+=t.g,this.b+=t.b,this}addColors(t,e){return this.r=t.r+e.r,this.g=t.g+e.g,this.b=t.b+e.b,this}addScalar(t){return this.r+=t,this.g+=t,this.b+=t,this}sub(t){return this.r=Math.max(0,this.r-t.r),this.g=Math.max(0,this.g-t.g),this.b=Math.max(0,this.b-t.b),this}multiply(t){return this.r*=t.r,this.g*=t.g,this.b*=t.b,this}multiplyScalar(t){return this.r*=t,this.g*=t,this.b*=t,this}lerp(t,e){return this.r+=(t.r-this.r)*e,this.g+=(t.g-this.g)*e,this.b+=(t.b-this.b)*e,this}lerpColors(t,e,i){return this.r=t.r+(e.r-t.r)*i,this.g=t.g+(e.g-t.g)*i,this.b=t.b+(e.b-t.b)*i,this}lerpHSL(t,e){this.getHSL(Fi),t.getHSL(Qa);let i=mo(Fi.h,Qa.h,e),s=mo(Fi.s,Qa.s,e),r=mo(Fi.l,Qa.l,e);return this.setHSL(i,s,r),this}setFromVector3(t){return this.r=t.x,this.g=t.y,this.b=t.z,this}applyMatrix3(t){let e=this.r,i=this.g,s=this.b,r=t.elements;return this.r=r[0]*e+r[3]*i+r[6]*s,this.g=r[1]*e+r[4]*i+r[7]*s,this.b=r[2]*e+r[5]*i+r[8]*s,this}equals(t){return t.r===this.r&&t.g===this.g&&t.b===this.b}fromArray(t,e=0){return this.r=t[e],this.g=t[e+1],this.b=t[e+2],this}toArray(t=[],e=0){return t[e]=this.r,t[e+1]=this.g,t[e+2]=this.b,t}fromBufferAttribute(t,e){return this.r=t.getX(e),this.g=t.getY(e),this.b=t.getZ(e),this}toJSON(){return this.getHex()}*[Symbol.iterator](){yield this.r,yield this.g,yield this.b}},Xe=new Gt;Gt.NAMES=D0;var wo=class extends De{constructor(){super(),this.isScene=!0,this.type="Scene",this.background=null,this.environment=null,this.fog=null,this.backgroundBlurriness=0,this.backgroundIntensity=1,this.backgroundRotation=new mi,this.environmentIntensity=1,this.environmentRotation=new mi,this.overrideMaterial=null,typeof __THREE_DEVTOOLS__<"u"&&__THREE_DEVTOOLS__.dispatchEvent(new CustomEvent("observe",{detail:this}))}copy(t,e){return super.copy(t,e),this.background=t.background!==null?t.background.clone():null,this.environment=t.environment!==null?t.environment.clone():null,this.fog=t.fog!==null?t.fog.clone():null,this.backgroundBlurriness=t.backgroundBlurriness,this.backgroundIntensity=t.backgroundIntensity,this.backgroundRotation.copy(t.backgroundRotation),this.environmentIntensity=t.environmentIntensity,this.environmentRotation.copy(t.environmentRotation),this.overrideMaterial=t.overrideMaterial!==null?t.overrideMaterial.clone():null,this.matrixAutoUpdate=t.matrixAutoUpdate,this}toJSON(t){let e=super.toJSON(t);return this.fog!==null&&(e.object.fog=this.fog.toJSON()),e.object.backgroundBlurriness=this.backgroundBlurriness,e.object.backgroundIntensity=this.backgroundIntensity,e.object.backgroundRotation=this.backgroundRotation.toArray(),e.object.environmentIntensity=this.environmentIntensity,e.object.environmentRotation=this.environmentRotation.toArray(),e}},Dn=new P,li=new P,Wu=new P,ci=new P,rr=new P,or=new P,Mg=new P,Xu=new P,$u=new P,qu=new P,Yu=new oe,Zu=new oe,Ju=new oe,fi=class n{constructor(t=new P,e=new P,i=new P){this.a=t,this.b=e,this.c=i}static getNormal(t,e,i,s){s.subVectors(i,e),Dn.subVectors(t,e),s.cross(Dn);let r=s.lengthSq();return r>0?s.multiplyScalar(1/Math.sqrt(r)):s.set(0,0,0)}static getBarycoord(t,e,i,s,r){Dn.subVectors(s,e),li.subVectors(i,e),Wu.subVectors(t,e);let o=Dn.dot(Dn),a=Dn.dot(li),c=Dn.dot(Wu),l=li.dot(li),h=li.dot(Wu),u=o*l-a*a;if(u===0)return r.set(0,0,0),null;let f=1/u,d=(l*c-a*h)*f,m=(o*h-a*c)*f;return r.set(1-d-m,m,d)}static containsPoint(t,e,i,s){return this.getBarycoord(t,e,i,s,ci)===null?!1:ci.x>=0&&ci.y>=0&&ci.x+ci.y<=1}static getInterpolation(t,e,i,s,r,o,a,c){return this.getBarycoord(t,e,i,s,ci)===null?(c.x=0,c.y=0,"z"in c&&(c.z=0),"w"in c&&(c.w=0),null):(c.setScalar(0),c.addScaledVector(r,ci.x),c.addScaledVector(o,ci.y),c.addScaledVector(a,ci.z),c)}static getInterpolatedAttribute(t,e,i,s,r,o){return Yu.setScalar(0),Zu.setScalar(0),Ju.setScalar(0),Yu.fromBufferAttribute(t,e),Zu.fromBufferAttribute(t,i),Ju.fromBufferAttribute(t,s),o.setScalar(0),o.addScaledVector(Yu,r.x),o.addScaledVector(Zu,r.y),o.addScaledVector(Ju,r.z),o}static isFrontFacing(t,e,i,s){return Dn.subVectors(i,e),li.subVectors(t,e),Dn.cross(li).dot(s)<0}set(t,e,i){return this.a.copy(t),this.b.copy(e),this.c.copy(i),this}setFromPointsAndIndices(t,e,i,s){return this.a.copy(t[e]),this.b.copy(t[i]),this.c.copy(t[s]),this}setFromAttributeAndIndices(t,e,i,s){return this.a.fromBufferAttribute(t,e),this.b.fromBufferAttribute(t,i),this.c.fromBufferAttribute(t,s),this}clone(){return new this.constructor().copy(this)}copy(t){return this.a.copy(t.a),this.b.copy(t.b),this.c.copy(t.c),this}getArea(){return Dn.subVectors(this.c,this.b),li.subVectors(this.a,this.b),Dn.cross(li).length()*.5}getMidpoint(t){return t.addVectors(this.a,this.b).add(this.c).multiplyScalar(1/3)}getNormal(t){return n.getNormal(this.a,this.b,this.c,t)}getPlane(t){return t.setFromCoplanarPoints(this.a,this.b,this.c)}getBarycoord(t,e){return n.getBarycoord(t,this.a,this.b,this.c,e)}getInterpolation(t,e,i,s,r){return n.getInterpolation(t,this.a,this.b,this.c,e,i,s,r)}containsPoint(t){return n.containsPoint(t,this.a,this.b,this.c)}isFrontFacing(t){return n.isFrontFacing(this.a,this.b,this.c,t)}intersectsBox(t){return t.intersectsTriangle(this)}closestPointToPoint(t,e){let i=this.a,s=this.b,r=this.c,o,a;rr.subVectors(s,i),or.subVectors(r,i),Xu.subVectors(t,i);let c=rr.dot(Xu),l=or.dot(Xu);if(c<=0&&l<=0)return e.copy(i);$u.subVectors(t,s);let h=rr.dot($u),u=or.dot($u);if(h>=0&&u<=h)return e.copy(s);let f=c*u-h*l;if(f<=0&&c>=0&&h<=0&&c-h>0)return o=c/(c-h),e.copy(i).addScaledVector(rr,o);qu.subVectors(t,r);let d=rr.dot(qu),m=or.dot(qu);if(m>=0&&d<=m)return e.copy(r);let _=d*l-c*m;if(_<=0&&l>=0&&m<=0)return a=l/(l-m),e.copy(i).addScaledVector(or,a);let p=h*m-d*u;if(p<=0&&u-h>=0&&d-m>=0)return Mg.subVectors(r,s),a=(u-h)/(u-h+(d-m)),e.copy(s).addScaledVector(Mg,a);let g=1/(p+_+f);return o=_*g,a=f*g,e.copy(i).addScaledVector(rr,o).addScaledVector(or,a)}equals(t){return t.a.equals(this.a)&&t.b.equals(this.b)&&t.c.equals(this.c)}},un=class{constructor(t=new P(1/0,1/0,1/0),e=new P(-1/0,-1/0,-1/0)){this.isBox3=!0,this.min=t,this.max=e}set(t,e){return this.min.copy(t),this.max.copy(e),this}setFromArray(t){this.makeEmpty();for(let e=0,i=t.length;e<i;e+=3)this.expandByPoint(Un.fromArray(t,e));return this}setFromBufferAttribute(t){this.makeEmpty();for(let e=0,i=t.count;e<i;e++)this.expandByPoint(Un.fromBufferAttribute(t,e));return this}setFromPoints(t){this.makeEmpty();for(let e=0,i=t.length;e<i;e++)this.expandByPoint(t[e]);return this}setFromCenterAndSize(t,e){let i=Un.copy(e).multiplyScalar(.5);return this.min.copy(t).sub(i),this.max.copy(t).add(i),this}setFromObject(t,e=!1){return this.makeEmpty(),this.expandByObject(t,e)}clone(){return new this.constructor().copy(this)}copy(t){return this.min.copy(t.min),this.max.copy(t.max),this}makeEmpty(){return this.min.x=this.min.y=this.min.z=1/0,this.max.x=this.max.y=this.max.z=-1/0,this}isEmpty(){return this.max.x<this.min.x||this.max.y<this.min.y||this.max.z<this.min.z}getCenter(t){return this.isEmpty()?t.set(0,0,0):t.addVectors(this.min,this.max).multiplyScalar(.5)}getSize(t){return this.isEmpty()?t.set(0,0,0):t.subVectors(this.max,this.min)}expandByPoint(t){return this.min.min(t),this.max.max(t),this}expandByVector(t){return this.min.sub(t),this.max.add(t),this}expandByScalar(t){return this.min.addScalar(-t),this.max.addScalar(t),this}expandByObject(t,e=!1){t.updateWorldMatrix(!1,!1);let i=t.geometry;if(i!==void 0){let r=i.getAttribute("position");if(e===!0&&r!==void 0&&t.isInstancedMesh!==!0&&t.isBatchedMesh!==!0)for(let o=0,a=r.count;o<a;o++)t.isMesh===!0?t.getVertexPosition(o,Un):Un.fromBufferAttribute(r,o),Un.applyMatrix4(t.matrixWorld),this.expandByPoint(Un);else t.boundingBox!==void 0?(t.boundingBox===null&&t.computeBoundingBox(),tl.copy(t.boundingBox)):(i.boundingBox===null&&i.computeBoundingBox(),tl.copy(i.boundingBox)),tl.applyMatrix4(t.matrixWorld),this.union(tl)}let s=t.children;for(let r=0,o=s.length;r<o;r++)this.expandByObject(s[r],e);return this}containsPoint(t){return t.x>=this.min.x&&t.x<=this.max.x&&t.y>=this.min.y&&t.y<=this.max.y&&t.z>=this.min.z&&t.z<=this.max.z}containsBox(t){return this.min.x<=t.min.x&&t.max.x<=this.max.x&&this.min.y<=t.min.y&&t.max.y<=this.max.y&&this.min.z<=t.min.z&&t.max.z<=this.max.z}getParameter(t,e){return e.set((t.x-this.min.x)/(this.max.x-this.min.x),(t.y-this.min.y)/(this.max.y-this.min.y),(t.z-this.min.z)/(this.max.z-this.min.z))}intersectsBox(t){return t.max.x>=this.min.x&&t.min.x<=this.max.x&&t.max.y>=this.min.y&&t.min.y<=this.max.y&&t.max.z>=this.min.z&&t.min.z<=this.max.z}intersectsSphere(t){return this.clampPoint(t.center,Un),Un.distanceToSquared(t.center)<=t.radius*t.radius}intersectsPlane(t){let e,i;return t.normal.x>0?(e=t.normal.x*this.min.x,i=t.normal.x*this.max.x):(e=t.normal.x*this.max.x,i=t.normal.x*this.min.x),t.normal.y>0?(e+=t.normal.y*this.min.y,i+=t.normal.y*this.max.y):(e+=t.normal.y*this.max.y,i+=t.normal.y*this.min.y),t.normal.z>0?(e+=t.normal.z*this.min.z,i+=t.normal.z*this.max.z):(e+=t.normal.z*this.max.z,i+=t.normal.z*this.min.z),e<=-t.constant&&i>=-t.constant}intersectsTriangle(t){if(this.isEmpty())return!1;this.getCenter(lo),el.subVectors(this.max,lo),ar.subVectors(t.a,lo),lr.subVectors(t.b,lo),cr.subVectors(t.c,lo),Bi.subVectors(lr,ar),ki.subVectors(cr,lr),bs.subVectors(ar,cr);let e=[0,-Bi.z,Bi.y,0,-ki.z,ki.y,0,-bs.z,bs.y,Bi.z,0,-Bi.x,ki.z,0,-ki.x,bs.z,0,-bs.x,-Bi.y,Bi.x,0,-ki.y,ki.x,0,-bs.y,bs.x,0];return!ju(e,ar,lr,cr,el)||(e=[1,0,0,0,1,0,0,0,1],!ju(e,ar,lr,cr,el))?!1:(nl.crossVectors(Bi,ki),e=[nl.x,nl.y,nl.z],ju(e,ar,lr,cr,el))}clampPoint(t,e){return e.copy(t).clamp(this.min,this.max)}distanceToPoint(t){return this.clampPoint(t,Un).distanceTo(t)}getBoundingSphere(t){return this.isEmpty()?t.makeEmpty():(this.getCenter(t.center),t.radius=this.getSize(Un).length()*.5),t}intersect(t){return this.min.max(t.min),this.max.min(t.max),this.isEmpty()&&this.makeEmpty(),this}union(t){return this.min.min(t.min),this.max.max(t.max),this}applyMatrix4(t){return this.isEmpty()?this:(hi[0].set(this.min.x,this.min.y,this.min.z).applyMatrix4(t),hi[1].set(this.min.x,this.min.y,this.max.z).applyMatrix4(t),hi[2].set(this.min.x,this.max.y,this.min.z).applyMatrix4(t),hi[3].set(this.min.x,this.max.y,this.max.z).applyMatrix4(t),hi[4].set(this.max.x,this.min.y,this.min.z).applyMatrix4(t),hi[5].set(this.max.x,this.min.y,this.max.z).applyMatrix4(t),hi[6].set(this.max.x,this.max.y,this.min.z).applyMatrix4(t),hi[7].set(this.max.x,this.max.y,this.max.z).applyMatrix4(t),this.setFromPoints(hi),this)}translate(t){return this.min.add(t),this.max.add(t),this}equals(t){return t.min.equals(this.min)&&t.max.equals(this.max)}toJSON(){return{min:this.min.toArray(),max:this.max.toArray()}}fromJSON(t){return this.min.fromArray(t.min),this.max.fromArray(t.max),this}},hi=[new P,new P,new P,new P,new P,new P,new P,new P],Un=new P,tl=new un,ar=new P,lr=new P,cr=new P,Bi=new P,ki=new P,bs=new P,lo=new P,el=new P,nl=new P,Ms=new P;function ju(n,t,e,i,s){for(let r=0,o=n.length-3;r<=o;r+=3){Ms.fromArray(n,r);let a=s.x*Math.abs(Ms.x)+s.y*Math.abs(Ms.y)+s.z*Math.abs(Ms.z),c=t.dot(Ms),l=e.dot(Ms),h=i.dot(Ms);if(Math.max(-Math.max(c,l,h),Math.min(c,l,h))>a)return!1}return!0}var be=new P,il=new ht,rb=0,On=class extends Fn{constructor(t,e,i=!1){if(super(),Array.isArray(t))throw new TypeError("THREE.BufferAttribute: array should be a Typed Array.");this.isBufferAttribute=!0,Object.defineProperty(this,"id",{value:rb++}),this.name="",this.array=t,this.itemSize=e,this.count=t!==void 0?t.length/e:0,this.normalized=i,this.usage=qf,this.updateRanges=[],this.gpuType=zn,this.version=0,this._normalizationScale=t!==void 0?nh(t):void 0}onUploadCallback(){}set needsUpdate(t){t===!0&&this.version++}setUsage(t){return this.usage=t,this}addUpdateRange(t,e){this.updateRanges.push({start:t,count:e})}clearUpdateRanges(){this.updateRanges.length=0}copy(t){return this.name=t.name,this.array=new t.array.constructor(t.array),this.itemSize=t.itemSize,this.count=t.count,this.normalized=t.normalized,this.usage=t.usage,this.gpuType=t.gpuType,this._normalizationScale=t._normalizationScale,this}copyAt(t,e,i){t*=this.itemSize,i*=e.itemSize;for(let s=0,r=this.itemSize;s<r;s++)this.array[t+s]=e.array[i+s];return this}copyArray(t){return this.array.set(t),this}applyMatrix3(t){if(this.itemSize===2)for(let e=0,i=this.count;e<i;e++)il.fromBufferAttribute(this,e),il.applyMatrix3(t),this.setXY(e,il.x,il.y);else if(this.itemSize===3)for(let e=0,i=this.count;e<i;e++)be.fromBufferAttribute(this,e),be.applyMatrix3(t),this.setXYZ(e,be.x,be.y,be.z);return this}applyMatrix4(t){for(let e=0,i=this.count;e<i;e++)be.fromBufferAttribute(this,e),be.applyMatrix4(t),this.setXYZ(e,be.x,be.y,be.z);return this}applyNormalMatrix(t){for(let e=0,i=this.count;e<i;e++)be.fromBufferAttribute(this,e),be.applyNormalMatrix(t),this.setXYZ(e,be.x,be.y,be.z);return this}transformDirection(t){for(let e=0,i=this.count;e<i;e++)be.fromBufferAttribute(this,e),be.transformDirection(t),this.setXYZ(e,be.x,be.y,be.z);return this}set(t,e=0){return this.array.set(t,e),this}getComponent(t,e){let i=this.array[t*this.itemSize+e];return this.normalized&&(i=this._denormalize(i)),i}setComponent(t,e,i){return this.normalized&&(i=this._normalize(i)),this.array[t*this.itemSize+e]=i,this}getX(t){let e=this.array[t*this.itemSize];return this.normalized&&(e=this._denormalize(e)),e}setX(t,e){return this.normalized&&(e=this._normalize(e)),this.array[t*this.itemSize]=e,this}getY(t){let e=this.array[t*this.itemSize+1];return this.normalized&&(e=this._denormalize(e)),e}setY(t,e){return this.normalized&&(e=this._normalize(e)),this.array[t*this.itemSize+1]=e,this}getZ(t){let e=this.array[t*this.itemSize+2];return this.normalized&&(e=this._denormalize(e)),e}setZ(t,e){return this.normalized&&(e=this._normalize(e)),this.array[t*this.itemSize+2]=e,this}getW(t){let e=this.array[t*this.itemSize+3];return this.normalized&&(e=this._denormalize(e)),e}setW(t,e){return this.normalized&&(e=this._normalize(e)),this.array[t*this.itemSize+3]=e,this}setXY(t,e,i){return t*=this.itemSize,this.normalized&&(e=this._normalize(e),i=this._normalize(i)),this.array[t+0]=e,this.array[t+1]=i,this}setXYZ(t,e,i,s){return t*=this.itemSize,this.normalized&&(e=this._normalize(e),i=this._normalize(i),s=this._normalize(s)),this.array[t+0]=e,this.array[t+1]=i,this.array[t+2]=s,this}setXYZW(t,e,i,s,r){return t*=this.itemSize,this.normalized&&(e=this._normalize(e),i=this._normalize(i),s=this._normalize(s),r=this._normalize(r)),this.array[t+0]=e,this.array[t+1]=i,this.array[t+2]=s,this.array[t+3]=r,this}onUpload(t){return this.onUploadCallback=t,this}clone(){return new this.constructor(this.array,this.itemSize).copy(this)}toJSON(){let t={itemSize:this.itemSize,type:this.array.constructor.name,array:Array.from(this.array),normalized:this.normalized};return t.name=this.name,t.usage=this.usage,t.gpuType=this.gpuType,t}dispose(){this.dispatchEvent({type:"dispose"})}_denormalize(t){let e=this._normalizationScale;return e!==void 0?Math.max(t/e,-1):jf(t,this.array)}_normalize(t){let e=this._normalizationScale;return e!==void 0?Math.round(t*e):Kf(t,this.array)}};var Ao=class extends On{constructor(t,e,i){super(new Uint16Array(t),e,i)}};var Eo=class extends On{constructor(t,e,i){super(new Uint32Array(t),e,i)}};var Vt=class extends On{constructor(t,e,i){super(new Float32Array(t),e,i)}},ob=new un,co=new P,Ku=new P,An=class{constructor(t=new P,e=-1){this.isSphere=!0,this.center=t,this.radius=e}set(t,e){return this.center.copy(t),this.radius=e,this}setFromPoints(t,e){let i=this.center;e!==void 0?i.copy(e):ob.setFromPoints(t).getCenter(i);let s=0;for(let r=0,o=t.length;r<o;r++)s=Math.max(s,i.distanceToSquared(t[r]));return this.radius=Math.sqrt(s),this}copy(t){return this.center.copy(t.center),this.radius=t.radius,this}isEmpty(){return this.radius<0}makeEmpty(){return this.center.set(0,0,0),this.radius=-1,this}containsPoint(t){return t.distanceToSquared(this.center)<=this.radius*this.radius}distanceToPoint(t){return t.distanceTo(this.center)-this.radius}intersectsSphere(t){let e=this.radius+t.radius;return t.center.distanceToSquared(this.center)<=e*e}intersectsBox(t){return t.intersectsSphere(this)}intersectsPlane(t){return Math.abs(t.distanceToPoint(this.center))<=this.radius}clampPoint(t,e){let i=this.center.distanceToSquared(t);return e.copy(t),i>this.radius*this.radius&&(e.sub(this.center).normalize(),e.multiplyScalar(this.radius).add(this.center)),e}getBoundingBox(t){return this.isEmpty()?(t.makeEmpty(),t):(t.set(this.center,this.center),t.expandByScalar(this.radius),t)}applyMatrix4(t){return this.center.applyMatrix4(t),this.radius=this.radius*t.getMaxScaleOnAxis(),this}translate(t){return this.center.add(t),this}expandByPoint(t){if(this.isEmpty())return this.center.copy(t),this.radius=0,this;co.subVectors(t,this.center);let e=co.lengthSq();if(e>this.radius*this.radius){let i=Math.sqrt(e),s=(i-this.radius)*.5;this.center.addScaledVector(co,s/i),this.radius+=s}return this}union(t){return t.isEmpty()?this:this.isEmpty()?(this.copy(t),this):(this.center.equals(t.center)===!0?this.radius=Math.max(this.radius,t.radius):(Ku.subVectors(t.center,this.center).setLength(t.radius),this.expandByPoint(co.copy(t.center).add(Ku)),this.expandByPoint(co.copy(t.center).sub(Ku))),this)}equals(t){return t.center.equals(this.center)&&t.radius===this.radius}clone(){return new this.constructor().copy(this)}toJSON(){return{radius:this.radius,center:this.center.toArray()}}fromJSON(t){return this.radius=t.radius,this.center.fromArray(t.center),this}},ab=0,Sn=new re,Qu=new De,hr=new P,cn=new un,ho=new un,Re=new P,ae=class n extends Fn{constructor(){super(),this.isBufferGeometry=!0,Object.defineProperty(this,"id",{value:ab++}),this.uuid=wi(),this.name="",this.type="BufferGeometry",this.index=null,this.indirect=null,this.indirectOffset=0,this.attributes={},this.morphAttributes={},this.morphTargetsRelative=!1,this.groups=[],this.boundingBox=null,this.boundingSphere=null,this.drawRange={start:0,count:1/0},this.userData={},this._transformed=!1}getIndex(){return this.index}setIndex(t){return Array.isArray(t)?this.index=new(Lv(t)?Eo:Ao)(t,1):this.index=t,this}setIndirect(t,e=0){return this.indirect=t,this.indirectOffset=e,this}getIndirect(){return this.indirect}getAttribute(t){return this.attributes[t]}setAttribute(t,e){return this.attributes[t]=e,this}deleteAttribute(t){return delete this.attributes[t],this}hasAttribute(t){return this.attributes[t]!==void 0}addGroup(t,e,i=0){this.groups.push({start:t,count:e,materialIndex:i})}clearGroups(){this.groups=[]}setDrawRange(t,e){this.drawRange.start=t,this.drawRange.count=e}applyMatrix4(t){let e=this.attributes.position;e!==void 0&&(e.applyMatrix4(t),e.needsUpdate=!0);let i=this.attributes.normal;if(i!==void 0){let r=new Bt().getNormalMatrix(t);i.applyNormalMatrix(r),i.needsUpdate=!0}let s=this.attributes.tangent;return s!==void 0&&(s.transformDirection(t),s.needsUpdate=!0),this.boundingBox!==null&&this.computeBoundingBox(),this.boundingSphere!==null&&this.computeBoundingSphere(),this._transformed=!0,this}applyQuaternion(t){return Sn.makeRotationFromQuaternion(t),this.applyMatrix4(Sn),this}rotateX(t){return Sn.makeRotationX(t),this.applyMatrix4(Sn),this}rotateY(t){return Sn.makeRotationY(t),this.applyMatrix4(Sn),this}rotateZ(t){return Sn.makeRotationZ(t),this.applyMatrix4(Sn),this}translate(t,e,i){return Sn.makeTranslation(t,e,i),this.applyMatrix4(Sn),this}scale(t,e,i){return Sn.makeScale(t,e,i),this.applyMatrix4(Sn),this}lookAt(t){return Qu.lookAt(t),Qu.updateMatrix(),this.applyMatrix4(Qu.matrix),this}center(){return this.computeBoundingBox(),this.boundingBox.getCenter(hr).negate(),this.translate(hr.x,hr.y,hr.z),this}setFromPoints(t){let e=this.getAttribute("position");if(e===void 0){let i=[];for(let s=0,r=t.length;s<r;s++){let o=t[s];i.push(o.x,o.y,o.z||0)}this.setAttribute("position",new Vt(i,3))}else{let i=Math.min(t.length,e.count);for(let s=0;s<i;s++){let r=t[s];e.setXYZ(s,r.x,r.y,r.z||0)}t.length>e.count&&Nt("BufferGeometry: Buffer size too small for points data. Use .dispose() and create a new geometry."),e.needsUpdate=!0}return this}computeBoundingBox(){this.boundingBox===null&&(this.boundingBox=new un);let t=this.attributes.position,e=this.morphAttributes.position;if(t&&t.isGLBufferAttribute){Ot("BufferGeometry.computeBoundingBox(): GLBufferAttribute requires a manual bounding box.",this),this.boundingBox.set(new P(-1/0,-1/0,-1/0),new P(1/0,1/0,1/0));return}if(t!==void 0){if(this.boundingBox.setFromBufferAttribute(t),e)for(let i=0,s=e.length;i<s;i++){let r=e[i];cn.setFromBufferAttribute(r),this.morphTargetsRelative?(Re.addVectors(this.boundingBox.min,cn.min),this.boundingBox.expandByPoint(Re),Re.addVectors(this.boundingBox.max,cn.max),this.boundingBox.expandByPoint(Re)):(this.boundingBox.expandByPoint(cn.min),this.boundingBox.expandByPoint(cn.max))}}else this.boundingBox.makeEmpty();(isNaN(this.boundingBox.min.x)||isNaN(this.boundingBox.min.y)||isNaN(this.boundingBox.min.z))&&Ot('BufferGeometry.computeBoundingBox(): Computed min/max have NaN values. The "position" attribute is likely to have NaN values.',this)}computeBoundingSphere(){this.boundingSphere===null&&(this.boundingSphere=new An);let t=this.attributes.position,e=this.morphAttributes.position;if(t&&t.isGLBufferAttribute){Ot("BufferGeometry.computeBoundingSphere(): GLBufferAttribute requires a manual bounding sphere.",this),this.boundingSphere.set(new P,1/0);return}if(t){let i=this.boundingSphere.center;if(cn.setFromBufferAttribute(t),e)for(let r=0,o=e.length;r<o;r++){let a=e[r];ho.setFromBufferAttribute(a),this.morphTargetsRelative?(Re.addVectors(cn.min,ho.min),cn.expandByPoint(Re),Re.addVectors(cn.max,ho.max),cn.expandByPoint(Re)):(cn.expandByPoint(ho.min),cn.expandByPoint(ho.max))}cn.getCenter(i);let s=0;for(let r=0,o=t.count;r<o;r++)Re.fromBufferAttribute(t,r),s=Math.max(s,i.distanceToSquared(Re));if(e)for(let r=0,o=e.length;r<o;r++){let a=e[r],c=this.morphTargetsRelative;for(let l=0,h=a.count;l<h;l++)Re.fromBufferAttribute(a,l),c&&(hr.fromBufferAttribute(t,l),Re.add(hr)),s=Math.max(s,i.distanceToSquared(Re))}this.boundingSphere.radius=Math.sqrt(s),isNaN(this.boundingSphere.radius)&&Ot('BufferGeometry.computeBoundingSphere(): Computed radius is NaN. The "position" attribute is likely to have NaN values.',this)}}computeTangents(){let t=this.index,e=this.attributes;if(t===null||e.position===void 0||e.normal===void 0||e.uv===void 0){Ot("BufferGeometry: .computeTangents() failed. Missing required attributes (index, position, normal or uv)");return}let i=e.position,s=e.normal,r=e.uv,o=this.getAttribute("tangent");(o===void 0||o.count!==i.count)&&(o=new On(new Float32Array(4*i.count),4),this.setAttribute("tangent",o));let a=[],c=[],l=new Uint8Array(i.count);for(let L=0;L<i.count;L++)a[L]=new P,c[L]=new P;let h=new P,u=new P,f=new P,d=new ht,m=new ht,_=new ht,p=new P,g=new P;function x(L,R,D){l[L]=l[R]=l[D]=1,h.fromBufferAttribute(i,L),u.fromBufferAttribute(i,R),f.fromBufferAttribute(i,D),d.fromBufferAttribute(r,L),m.fromBufferAttribute(r,R),_.fromBufferAttribute(r,D),u.sub(h),f.sub(h),m.sub(d),_.sub(d);let N=1/(m.x*_.y-_.x*m.y);isFinite(N)&&(p.copy(u).multiplyScalar(_.y).addScaledVector(f,-m.y).multiplyScalar(N),g.copy(f).multiplyScalar(m.x).addScaledVector(u,-_.x).multiplyScalar(N),a[L].add(p),a[R].add(p),a[D].add(p),c[L].add(g),c[R].add(g),c[D].add(g))}let b=this.groups;b.length===0&&(b=[{start:0,count:t.count}]);for(let L=0,R=b.length;L<R;++L){let D=b[L],N=D.start,B=D.count;for(let C=N,z=N+B;C<z;C+=3)x(t.getX(C+0),t.getX(C+1),t.getX(C+2))}let v=new P,w=new P,E=new P,y=new P;function M(L){E.fromBufferAttribute(s,L),y.copy(E);let R=a[L];v.copy(R),v.sub(E.multiplyScalar(E.dot(R))).normalize(),w.crossVectors(y,R);let N=w.dot(c[L])<0?-1:1;o.setXYZW(L,v.x,v.y,v.z,N)}for(let L=0,R=i.count;L<R;++L)l[L]&&M(L);this._transformed=!0}computeVertexNormals(){let t=this.index,e=this.getAttribute("position");if(e!==void 0){let i=this.getAttribute("normal");if(i===void 0||i.count!==e.count)i=new On(new Float32Array(e.count*3),3),this.setAttribute("normal",i);else for(let f=0,d=i.count;f<d;f++)i.setXYZ(f,0,0,0);let s=new P,r=new P,o=new P,a=new P,c=new P,l=new P,h=new P,u=new P;if(t)for(let f=0,d=t.count;f<d;f+=3){let m=t.getX(f+0),_=t.getX(f+1),p=t.getX(f+2);s.fromBufferAttribute(e,m),r.fromBufferAttribute(e,_),o.fromBufferAttribute(e,p),h.subVectors(o,r),u.subVectors(s,r),h.cross(u),a.fromBufferAttribute(i,m),c.fromBufferAttribute(i,_),l.fromBufferAttribute(i,p),a.add(h),c.add(h),l.add(h),i.setXYZ(m,a.x,a.y,a.z),i.setXYZ(_,c.x,c.y,c.z),i.setXYZ(p,l.x,l.y,l.z)}else for(let f=0,d=e.count;f<d;f+=3)s.fromBufferAttribute(e,f+0),r.fromBufferAttribute(e,f+1),o.fromBufferAttribute(e,f+2),h.subVectors(o,r),u.subVectors(s,r),h.cross(u),i.setXYZ(f+0,h.x,h.y,h.z),i.setXYZ(f+1,h.x,h.y,h.z),i.setXYZ(f+2,h.x,h.y,h.z);this.normalizeNormals(),i.needsUpdate=!0}}normalizeNormals(){let t=this.attributes.normal;for(let e=0,i=t.count;e<i;e++)Re.fromBufferAttribute(t,e),Re.normalize(),t.setXYZ(e,Re.x,Re.y,Re.z)}toNonIndexed(){function t(a,c){let l=a.array,h=a.itemSize,u=a.normalized,f=new l.constructor(c.length*h),d=0,m=0;for(let _=0,p=c.length;_<p;_++){a.isInterleavedBufferAttribute?d=c[_]*a.data.stride+a.offset:d=c[_]*h;for(let g=0;g<h;g++)f[m++]=l[d++]}return new On(f,h,u)}if(this.index===null)return Nt("BufferGeometry.toNonIndexed(): BufferGeometry is already non-indexed."),this;let e=new n,i=this.index.array,s=this.attributes;for(let a in s){let c=s[a],l=t(c,i);e.setAttribute(a,l)}let r=this.morphAttributes;for(let a in r){let c=[],l=r[a];for(let h=0,u=l.length;h<u;h++){let f=l[h],d=t(f,i);c.push(d)}e.morphAttributes[a]=c}e.morphTargetsRelative=this.morphTargetsRelative;let o=this.groups;for(let a=0,c=o.length;a<c;a++){let l=o[a];e.addGroup(l.start,l.count,l.materialIndex)}return e}toJSON(){let t={metadata:{version:4.7,type:"BufferGeometry",generator:"BufferGeometry.toJSON"}};if(t.uuid=this.uuid,t.type=this.parameters!==void 0&&this._transformed===!0?"BufferGeometry":this.type,t.name=this.name,Object.keys(this.userData).length>0&&(t.userData=this.userData),this.parameters!==void 0&&this._transformed!==!0){let c=this.parameters;for(let l in c)c[l]!==void 0&&(t[l]=c[l]);return t}t.data={attributes:{}};let e=this.index;e!==null&&(t.data.index={type:e.array.constructor.name,array:Array.prototype.slice.call(e.array)});let i=this.attributes;for(let c in i){let l=i[c];t.data.attributes[c]=l.toJSON(t.data)}let s={},r=!1;for(let c in this.morphAttributes){let l=this.morphAttributes[c],h=[];for(let u=0,f=l.length;u<f;u++){let d=l[u];h.push(d.toJSON(t.data))}h.length>0&&(s[c]=h,r=!0)}r&&(t.data.morphAttributes=s,t.data.morphTargetsRelative=this.morphTargetsRelative);let o=this.groups;o.length>0&&(t.data.groups=JSON.parse(JSON.stringify(o)));let a=this.boundingSphere;return a!==null&&(t.data.boundingSphere=a.toJSON()),t}clone(){return new this.constructor().copy(this)}copy(t){this.index=null,this.attributes={},this.morphAttributes={},this.groups=[],this.boundingBox=null,this.boundingSphere=null;let e={};this.name=t.name;let i=t.index;i!==null&&this.setIndex(i.clone());let s=t.attributes;for(let l in s){let h=s[l];this.setAttribute(l,h.clone(e))}let r=t.morphAttributes;for(let l in r){let h=[],u=r[l];for(let f=0,d=u.length;f<d;f++)h.push(u[f].clone(e));this.morphAttributes[l]=h}this.morphTargetsRelative=t.morphTargetsRelative;let o=t.groups;for(let l=0,h=o.length;l<h;l++){let u=o[l];this.addGroup(u.start,u.count,u.materialIndex)}let a=t.boundingBox;a!==null&&(this.boundingBox=a.clone());let c=t.boundingSphere;return c!==null&&(this.boundingSphere=c.clone()),this.drawRange.start=t.drawRange.start,this.drawRange.count=t.drawRange.count,this.userData=t.userData,this._transformed=t._transformed,this}dispose(){this.dispatchEvent({type:"dispose"})}},Gl=class{constructor(t,e){this.isInterleavedBuffer=!0,this.array=t,this.stride=e,this.count=t!==void 0?t.length/e:0,this.usage=qf,this.updateRanges=[],this.version=0,this.uuid=wi()}onUploadCallback(){}set needsUpdate(t){t===!0&&this.version++}setUsage(t){return this.usage=t,this}addUpdateRange(t,e){this.updateRanges.push({start:t,count:e})}clearUpdateRanges(){this.updateRanges.length=0}copy(t){return this.array=new t.array.constructor(t.array),this.count=t.count,this.stride=t.stride,this.usage=t.usage,this}copyAt(t,e,i){t*=this.stride,i*=e.stride;for(let s=0,r=this.stride;s<r;s++)this.array[t+s]=e.array[i+s];return this}set(t,e=0){return this.array.set(t,e),this}clone(t){t.arrayBuffers===void 0&&(t.arrayBuffers={});let e=Sg(this.array);t.arrayBuffers[e]===void 0&&(t.arrayBuffers[e]=this.array.slice(0).buffer);let i=new this.array.constructor(t.arrayBuffers[e]),s=new this.constructor(i,this.stride);return s.setUsage(this.usage),s}onUpload(t){return this.onUploadCallback=t,this}toJSON(t){t.arrayBuffers===void 0&&(t.arrayBuffers={});let e=Sg(this.array);t.arrayBuffers[e]===void 0&&(t.arrayBuffers[e]=Array.from(new Uint32Array(this.array.slice(0).buffer)));let i={uuid:this.uuid,buffer:e,type:this.array.constructor.name,stride:this.stride};return i.usage=this.usage,i}};function Sg(n){return n.buffer._uuid===void 0&&(n.buffer._uuid=wi()),n.byteOffset===0&&n.byteLength===n.buffer.byteLength?n.buffer._uuid:n.buffer._uuid+":"+n.byteOffset+":"+n.byteLength}var Ye=new P,Bn=class n{constructor(t,e,i,s=!1){this.isInterleavedBufferAttribute=!0,this.name="",this.data=t,this.itemSize=e,this.offset=i,this.normalized=s,this._normalizationScale=t!==void 0?nh(t.array):void 0}get count(){return this.data.count}get array(){return this.data.array}set needsUpdate(t){this.data.needsUpdate=t}applyMatrix4(t){for(let e=0,i=this.data.count;e<i;e++)Ye.fromBufferAttribute(this,e),Ye.applyMatrix4(t),this.setXYZ(e,Ye.x,Ye.y,Ye.z);return this}applyNormalMatrix(t){for(let e=0,i=this.count;e<i;e++)Ye.fromBufferAttribute(this,e),Ye.applyNormalMatrix(t),this.setXYZ(e,Ye.x,Ye.y,Ye.z);return this}transformDirection(t){for(let e=0,i=this.count;e<i;e++)Ye.fromBufferAttribute(this,e),Ye.transformDirection(t),this.setXYZ(e,Ye.x,Ye.y,Ye.z);return this}getComponent(t,e){let i=this.array[t*this.data.stride+this.offset+e];return this.normalized&&(i=this._denormalize(i)),i}setComponent(t,e,i){return this.normalized&&(i=this._normalize(i)),this.data.array[t*this.data.stride+this.offset+e]=i,this}setX(t,e){return this.normalized&&(e=this._normalize(e)),this.data.array[t*this.data.stride+this.offset]=e,this}setY(t,e){return this.normalized&&(e=this._normalize(e)),this.data.array[t*this.data.stride+this.offset+1]=e,this}setZ(t,e){return this.normalized&&(e=this._normalize(e)),this.data.array[t*this.data.stride+this.offset+2]=e,this}setW(t,e){return this.normalized&&(e=this._normalize(e)),this.data.array[t*this.data.stride+this.offset+3]=e,this}getX(t){let e=this.data.array[t*this.data.stride+this.offset];return this.normalized&&(e=this._denormalize(e)),e}getY(t){let e=this.data.array[t*this.data.stride+this.offset+1];return this.normalized&&(e=this._denormalize(e)),e}getZ(t){let e=this.data.array[t*this.data.stride+this.offset+2];return this.normalized&&(e=this._denormalize(e)),e}getW(t){let e=this.data.array[t*this.data.stride+this.offset+3];return this.normalized&&(e=this._denormalize(e)),e}setXY(t,e,i){return t=t*this.data.stride+this.offset,this.normalized&&(e=this._normalize(e),i=this._normalize(i)),this.data.array[t+0]=e,this.data.array[t+1]=i,this}setXYZ(t,e,i,s){return t=t*this.data.stride+this.offset,this.normalized&&(e=this._normalize(e),i=this._normalize(i),s=this._normalize(s)),this.data.array[t+0]=e,this.data.array[t+1]=i,this.data.array[t+2]=s,this}setXYZW(t,e,i,s,r){return t=t*this.data.stride+this.offset,this.normalized&&(e=this._normalize(e),i=this._normalize(i),s=this._normalize(s),r=this._normalize(r)),this.data.array[t+0]=e,this.data.array[t+1]=i,this.data.array[t+2]=s,this.data.array[t+3]=r,this}clone(t){if(t===void 0){Mo("InterleavedBufferAttribute.clone(): Cloning an interleaved buffer attribute will de-interleave buffer data.");let e=[];for(let i=0;i<this.count;i++){let s=i*this.data.stride+this.offset;for(let r=0;r<this.itemSize;r++)e.push(this.data.array[s+r])}return new On(new this.array.constructor(e),this.itemSize,this.normalized)}else return t.interleavedBuffers===void 0&&(t.interleavedBuffers={}),t.interleavedBuffers[this.data.uuid]===void 0&&(t.interleavedBuffers[this.data.uuid]=this.data.clone(t)),new n(t.interleavedBuffers[this.data.uuid],this.itemSize,this.offset,this.normalized)}toJSON(t){if(t===void 0){Mo("InterleavedBufferAttribute.toJSON(): Serializing an interleaved buffer attribute will de-interleave buffer data.");let e=[];for(let i=0;i<this.count;i++){let s=i*this.data.stride+this.offset;for(let r=0;r<this.itemSize;r++)e.push(this.data.array[s+r])}return{itemSize:this.itemSize,type:this.array.constructor.name,array:e,normalized:this.normalized}}else return t.interleavedBuffers===void 0&&(t.interleavedBuffers={}),t.interleavedBuffers[this.data.uuid]===void 0&&(t.interleavedBuffers[this.data.uuid]=this.data.toJSON(t)),{isInterleavedBufferAttribute:!0,itemSize:this.itemSize,data:this.data.uuid,offset:this.offset,normalized:this.normalized}}_denormalize(t){let e=this._normalizationScale;return e!==void 0?Math.max(t/e,-1):jf(t,this.data.array)}_normalize(t){let e=this._normalizationScale;return e!==void 0?Math.round(t*e):Kf(t,this.data.array)}},tf=new P,lb=new P,cb=new Bt,Je=class{constructor(t=new P(1,0,0),e=0){this.isPlane=!0,this.normal=t,this.constant=e}set(t,e){return this.normal.copy(t),this.constant=e,this}setComponents(t,e,i,s){return this.normal.set(t,e,i),this.constant=s,this}setFromNormalAndCoplanarPoint(t,e){return this.normal.copy(t),this.constant=-e.dot(this.normal),this}setFromCoplanarPoints(t,e,i){let s=tf.subVectors(i,e).cross(lb.subVectors(t,e)).normalize();return this.setFromNormalAndCoplanarPoint(s,t),this}copy(t){return this.normal.copy(t.normal),this.constant=t.constant,this}normalize(){let t=1/this.normal.length();return this.normal.multiplyScalar(t),this.constant*=t,this}negate(){return this.constant*=-1,this.normal.negate(),this}distanceToPoint(t){return this.normal.dot(t)+this.constant}distanceToSphere(t){return this.distanceToPoint(t.center)-t.radius}projectPoint(t,e){return e.copy(t).addScaledVector(this.normal,-this.distanceToPoint(t))}intersectLine(t,e,i=!0){let s=t.delta(tf),r=this.normal.dot(s);if(r===0)return this.distanceToPoint(t.start)===0?e.copy(t.start):null;let o=-(t.start.dot(this.normal)+this.constant)/r;return i===!0&&(o<0||o>1)?null:e.copy(t.start).addScaledVector(s,o)}intersectsLine(t){let e=this.distanceToPoint(t.start),i=this.distanceToPoint(t.end);return e<0&&i>0||i<0&&e>0}intersectsBox(t){return t.intersectsPlane(this)}intersectsSphere(t){return t.intersectsPlane(this)}coplanarPoint(t){return t.copy(this.normal).multiplyScalar(-this.constant)}applyMatrix4(t,e){let i=e||cb.getNormalMatrix(t),s=this.coplanarPoint(tf).applyMatrix4(t),r=this.normal.applyMatrix3(i).normalize();return this.constant=-s.dot(r),this}translate(t){return this.constant-=t.dot(this.normal),this}equals(t){return t.normal.equals(this.normal)&&t.constant===this.constant}clone(){return new this.constructor().copy(this)}toJSON(){return{normal:this.normal.toArray(),constant:this.constant}}fromJSON(t){return this.normal.fromArray(t.normal),this.constant=t.constant,this}},hb=0,Yn=class extends Fn{constructor(){super(),this.isMaterial=!0,Object.defineProperty(this,"id",{value:hb++}),this.uuid=wi(),this.name="",this.type="Material",this.blending=Ur,this.side=Zi,this.vertexColors=!1,this.opacity=1,this.transparent=!1,this.alphaHash=!1,this.blendSrc=Tf,this.blendDst=Cf,this.blendEquation=Is,this.blendSrcAlpha=null,this.blendDstAlpha=null,this.blendEquationAlpha=null,this.blendColor=new Gt(0,0,0),this.blendAlpha=0,this.depthFunc=yr,this.depthTest=!0,this.depthWrite=!0,this.stencilWriteMask=255,this.stencilFunc=w0,this.stencilRef=0,this.stencilFuncMask=255,this.stencilFail=Cl,this.stencilZFail=Cl,this.stencilZPass=Cl,this.stencilWrite=!1,this.clippingPlanes=null,this.clipIntersection=!1,this.clipShadows=!1,this.shadowSide=null,this.colorWrite=!0,this.precision=null,this.polygonOffset=!1,this.polygonOffsetFactor=0,this.polygonOffsetUnits=0,this.dithering=!1,this.alphaToCoverage=!1,this.premultipliedAlpha=!1,this.forceSinglePass=!1,this.allowOverride=!0,this.visible=!0,this.toneMapped=!0,this.userData={},this.version=0,this._alphaTest=0}get alphaTest(){return this._alphaTest}set alphaTest(t){this._alphaTest>0!=t>0&&this.version++,this._alphaTest=t}onBeforeRender(){}onBeforeCompile(){}customProgramCacheKey(){return this.onBeforeCompile.toString()}setValues(t){if(t!==void 0)for(let e in t){let i=t[e];if(i===void 0){Nt(`Material: parameter '${e}' has value of undefined.`);continue}let s=this[e];if(s===void 0){Nt(`Material: '${e}' is not a property of THREE.${this.type}.`);continue}s&&s.isColor?s.set(i):s&&s.isVector2&&i&&i.isVector2||s&&s.isEuler&&i&&i.isEuler||s&&s.isVector3&&i&&i.isVector3?s.copy(i):this[e]=i}}toJSON(t){let e=t===void 0||typeof t=="string";e&&(t={textures:{},images:{}});let i={metadata:{version:4.7,type:"Material",generator:"Material.toJSON"}};i.uuid=this.uuid,i.type=this.type,i.blending=this.blending,i.side=this.side,i.shadowSide=this.shadowSide,i.vertexColors=this.vertexColors,i.opacity=this.opacity,i.transparent=this.transparent,i.blendSrc=this.blendSrc,i.blendDst=this.blendDst,i.blendEquation=this.blendEquation,i.blendSrcAlpha=this.blendSrcAlpha,i.blendDstAlpha=this.blendDstAlpha,i.blendEquationAlpha=this.blendEquationAlpha,i.blendColor=this.blendColor.getHex(),i.blendAlpha=this.blendAlpha,i.depthFunc=this.depthFunc,i.depthTest=this.depthTest,i.depthWrite=this.depthWrite,i.colorWrite=this.colorWrite,i.clipIntersection=this.clipIntersection,i.clipShadows=this.clipShadows,i.stencilWriteMask=this.stencilWriteMask,i.stencilFunc=this.stencilFunc,i.stencilRef=this.stencilRef,i.stencilFuncMask=this.stencilFuncMask,i.stencilFail=this.stencilFail,i.stencilZFail=this.stencilZFail,i.stencilZPass=this.stencilZPass,i.stencilWrite=this.stencilWrite,i.polygonOffset=this.polygonOffset,i.polygonOffsetFactor=this.polygonOffsetFactor,i.polygonOffsetUnits=this.polygonOffsetUnits,i.dithering=this.dithering,i.alphaTest=this.alphaTest,i.alphaHash=this.alphaHash,i.alphaToCoverage=this.alphaToCoverage,i.premultipliedAlpha=this.premultipliedAlpha,i.forceSinglePass=this.forceSinglePass,i.allowOverride=this.allowOverride,i.visible=this.visible,i.toneMapped=this.toneMapped,i.name=this.name,this.color&&this.color.isColor&&(i.color=this.color.getHex()),this.roughness!==void 0&&(i.roughness=this.roughness),this.metalness!==void 0&&(i.metalness=this.metalness),this.sheen!==void 0&&(i.sheen=this.sheen),this.sheenColor&&this.sheenColor.isColor&&(i.sheenColor=this.sheenColor.getHex()),this.sheenRoughness!==void 0&&(i.sheenRoughness=this.sheenRoughness),this.emissive&&this.emissive.isColor&&(i.emissive=this.emissive.getHex()),this.emissiveIntensity!==void 0&&(i.emissiveIntensity=this.emissiveIntensity),this.specular&&this.specular.isColor&&(i.specular=this.specular.getHex()),this.specularIntensity!==void 0&&(i.specularIntensity=this.specularIntensity),this.specularColor&&this.specularColor.isColor&&(i.specularColor=this.specularColor.getHex()),this.shininess!==void 0&&(i.shininess=this.shininess),this.clearcoat!==void 0&&(i.clearcoat=this.clearcoat),this.clearcoatRoughness!==void 0&&(i.clearcoatRoughness=this.clearcoatRoughness),this.diffuseRoughness!==void 0&&(i.diffuseRoughness=this.diffuseRoughness),this.diffuseRoughnessMap&&this.diffuseRoughnessMap.isTexture&&(i.diffuseRoughnessMap=this.diffuseRoughnessMap.toJSON(t).uuid),this.clearcoatMap&&this.clearcoatMap.isTexture&&(i.clearcoatMap=this.clearcoatMap.toJSON(t).uuid),this.clearcoatRoughnessMap&&this.clearcoatRoughnessMap.isTexture&&(i.clearcoatRoughnessMap=this.clearcoatRoughnessMap.toJSON(t).uuid),this.clearcoatNormalMap&&this.clearcoatNormalMap.isTexture&&(i.clearcoatNormalMap=this.clearcoatNormalMap.toJSON(t).uuid,i.clearcoatNormalScale=this.clearcoatNormalScale.toArray()),this.sheenColorMap&&this.sheenColorMap.isTexture&&(i.sheenColorMap=this.sheenColorMap.toJSON(t).uuid),this.sheenRoughnessMap&&this.sheenRoughnessMap.isTexture&&(i.sheenRoughnessMap=this.sheenRoughnessMap.toJSON(t).uuid),this.dispersion!==void 0&&(i.dispersion=this.dispersion),this.retroreflectivity!==void 0&&(i.retroreflectivity=this.retroreflectivity),this.iridescence!==void 0&&(i.iridescence=this.iridescence),this.iridescenceIOR!==void 0&&(i.iridescenceIOR=this.iridescenceIOR),this.iridescenceThicknessMinimum!==void 0&&(i.iridescenceThicknessMinimum=this.iridescenceThicknessMinimum),this.iridescenceThicknessMaximum!==void 0&&(i.iridescenceThicknessMaximum=this.iridescenceThicknessMaximum),this.iridescenceMap&&this.iridescenceMap.isTexture&&(i.iridescenceMap=this.iridescenceMap.toJSON(t).uuid),this.iridescenceThicknessMap&&this.iridescenceThicknessMap.isTexture&&(i.iridescenceThicknessMap=this.iridescenceThicknessMap.toJSON(t).uuid),this.anisotropy!==void 0&&(i.anisotropy=this.anisotropy),this.anisotropyRotation!==void 0&&(i.anisotropyRotation=this.anisotropyRotation),this.anisotropyMap&&this.anisotropyMap.isTexture&&(i.anisotropyMap=this.anisotropyMap.toJSON(t).uuid),this.map&&this.map.isTexture&&(i.map=this.map.toJSON(t).uuid),this.matcap&&this.matcap.isTexture&&(i.matcap=this.matcap.toJSON(t).uuid),this.alphaMap&&this.alphaMap.isTexture&&(i.alphaMap=this.alphaMap.toJSON(t).uuid),this.lightMap&&this.lightMap.isTexture&&(i.lightMap=this.lightMap.toJSON(t).uuid,i.lightMapIntensity=this.lightMapIntensity),this.aoMap&&this.aoMap.isTexture&&(i.aoMap=this.aoMap.toJSON(t).uuid,i.aoMapIntensity=this.aoMapIntensity),this.bumpMap&&this.bumpMap.isTexture&&(i.bumpMap=this.bumpMap.toJSON(t).uuid,i.bumpScale=this.bumpScale),this.normalMap&&this.normalMap.isTexture&&(i.normalMap=this.normalMap.toJSON(t).uuid,i.normalMapType=this.normalMapType,i.normalScale=this.normalScale.toArray()),this.displacementMap&&this.displacementMap.isTexture&&(i.displacementMap=this.displacementMap.toJSON(t).uuid,i.displacementScale=this.displacementScale,i.displacementBias=this.displacementBias),this.roughnessMap&&this.roughnessMap.isTexture&&(i.roughnessMap=this.roughnessMap.toJSON(t).uuid),this.metalnessMap&&this.metalnessMap.isTexture&&(i.metalnessMap=this.metalnessMap.toJSON(t).uuid),this.emissiveMap&&this.emissiveMap.isTexture&&(i.emissiveMap=this.emissiveMap.toJSON(t).uuid),this.specularMap&&this.specularMap.isTexture&&(i.specularMap=this.specularMap.toJSON(t).uuid),this.specularIntensityMap&&this.specularIntensityMap.isTexture&&(i.specularIntensityMap=this.specularIntensityMap.toJSON(t).uuid),this.specularColorMap&&this.specularColorMap.isTexture&&(i.specularColorMap=this.specularColorMap.toJSON(t).uuid),this.envMap&&this.envMap.isTexture&&(i.envMap=this.envMap.toJSON(t).uuid,this.combine!==void 0&&(i.combine=this.combine)),this.envMapRotation!==void 0&&(i.envMapRotation=this.envMapRotation.toArray()),this.envMapIntensity!==void 0&&(i.envMapIntensity=this.envMapIntensity),this.reflectivity!==void 0&&(i.reflectivity=this.reflectivity),this.refractionRatio!==void 0&&(i.refractionRatio=this.refractionRatio),this.gradientMap&&this.gradientMap.isTexture&&(i.gradientMap=this.gradientMap.toJSON(t).uuid),this.transmission!==void 0&&(i.transmission=this.transmission),this.transmissionMap&&this.transmissionMap.isTexture&&(i.transmissionMap=this.transmissionMap.toJSON(t).uuid),this.thickness!==void 0&&(i.thickness=this.thickness),this.thicknessMap&&this.thicknessMap.isTexture&&(i.thicknessMap=this.thicknessMap.toJSON(t).uuid),this.attenuationDistance!==void 0&&(i.attenuationDistance=this.attenuationDistance),this.attenuationColor!==void 0&&(i.attenuationColor=this.attenuationColor.getHex()),this.size!==void 0&&(i.size=this.size),this.sizeAttenuation!==void 0&&(i.sizeAttenuation=this.sizeAttenuation),Array.isArray(this.clippingPlanes)&&this.clippingPlanes.length>0&&(i.clippingPlanes=this.clippingPlanes.map(r=>r.toJSON())),this.rotation!==void 0&&(i.rotation=this.rotation),this.depthPacking!==void 0&&(i.depthPacking=this.depthPacking),this.linewidth!==void 0&&(i.linewidth=this.linewidth),this.linecap!==void 0&&(i.linecap=this.linecap),this.linejoin!==void 0&&(i.linejoin=this.linejoin),this.dashSize!==void 0&&(i.dashSize=this.dashSize),this.gapSize!==void 0&&(i.gapSize=this.gapSize),this.scale!==void 0&&(i.scale=this.scale),this.wireframe!==void 0&&(i.wireframe=this.wireframe),this.wireframeLinewidth!==void 0&&(i.wireframeLinewidth=this.wireframeLinewidth),this.wireframeLinecap!==void 0&&(i.wireframeLinecap=this.wireframeLinecap),this.wireframeLinejoin!==void 0&&(i.wireframeLinejoin=this.wireframeLinejoin),this.flatShading!==void 0&&(i.flatShading=this.flatShading),this.fog!==void 0&&(i.fog=this.fog),Object.keys(this.userData).length>0&&(i.userData=this.userData);function s(r){let o=[];for(let a in r){let c=r[a];delete c.metadata,o.push(c)}return o}if(e){let r=s(t.textures),o=s(t.images);r.length>0&&(i.textures=r),o.length>0&&(i.images=o)}return i}fromJSON(t,e){if(t.uuid!==void 0&&(this.uuid=t.uuid),t.name!==void 0&&(this.name=t.name),t.color!==void 0&&this.color!==void 0&&this.color.setHex(t.color),t.roughness!==void 0&&(this.roughness=t.roughness),t.metalness!==void 0&&(this.metalness=t.metalness),t.sheen!==void 0&&(this.sheen=t.sheen),t.sheenColor!==void 0&&(this.sheenColor=new Gt().setHex(t.sheenColor)),t.sheenRoughness!==void 0&&(this.sheenRoughness=t.sheenRoughness),t.emissive!==void 0&&this.emissive!==void 0&&this.emissive.setHex(t.emissive),t.specular!==void 0&&this.specular!==void 0&&this.specular.setHex(t.specular),t.specularIntensity!==void 0&&(this.specularIntensity=t.specularIntensity),t.specularColor!==void 0&&this.specularColor!==void 0&&this.specularColor.setHex(t.specularColor),t.shininess!==void 0&&(this.shininess=t.shininess),t.clearcoat!==void 0&&(this.clearcoat=t.clearcoat),t.clearcoatRoughness!==void 0&&(this.clearcoatRoughness=t.clearcoatRoughness),t.diffuseRoughness!==void 0&&(this.diffuseRoughness=t.diffuseRoughness),t.dispersion!==void 0&&(this.dispersion=t.dispersion),t.retroreflectivity!==void 0&&(this.retroreflectivity=t.retroreflectivity),t.iridescence!==void 0&&(this.iridescence=t.iridescence),t.iridescenceIOR!==void 0&&(this.iridescenceIOR=t.iridescenceIOR),t.iridescenceThicknessMinimum!==void 0&&(this.iridescenceThicknessMinimum=t.iridescenceThicknessMinimum),t.iridescenceThicknessMaximum!==void 0&&(this.iridescenceThicknessMaximum=t.iridescenceThicknessMaximum),t.iridescenceThicknessRange!==void 0&&(this.iridescenceThicknessMinimum=t.iridescenceThicknessRange[0],this.iridescenceThicknessMaximum=t.iridescenceThicknessRange[1]),t.transmission!==void 0&&(this.transmission=t.transmission),t.thickness!==void 0&&(this.thickness=t.thickness),t.attenuationDistance!==void 0&&(this.attenuationDistance=t.attenuationDistance),t.attenuationColor!==void 0&&this.attenuationColor!==void 0&&this.attenuationColor.setHex(t.attenuationColor),t.anisotropy!==void 0&&(this.anisotropy=t.anisotropy),t.anisotropyRotation!==void 0&&(this.anisotropyRotation=t.anisotropyRotation),t.fog!==void 0&&(this.fog=t.fog),t.flatShading!==void 0&&(this.flatShading=t.flatShading),t.blending!==void 0&&(this.blending=t.blending),t.combine!==void 0&&(this.combine=t.combine),t.side!==void 0&&(this.side=t.side),t.shadowSide!==void 0&&(this.shadowSide=t.shadowSide),t.opacity!==void 0&&(this.opacity=t.opacity),t.transparent!==void 0&&(this.transparent=t.transparent),t.alphaTest!==void 0&&(this.alphaTest=t.alphaTest),t.alphaHash!==void 0&&(this.alphaHash=t.alphaHash),t.depthFunc!==void 0&&(this.depthFunc=t.depthFunc),t.depthTest!==void 0&&(this.depthTest=t.depthTest),t.depthWrite!==void 0&&(this.depthWrite=t.depthWrite),t.colorWrite!==void 0&&(this.colorWrite=t.colorWrite),t.clippingPlanes!==void 0&&(this.clippingPlanes=t.clippingPlanes.map(i=>new Je().fromJSON(i))),t.clipIntersection!==void 0&&(this.clipIntersection=t.clipIntersection),t.clipShadows!==void 0&&(this.clipShadows=t.clipShadows),t.depthPacking!==void 0&&(this.depthPacking=t.depthPacking),t.blendSrc!==void 0&&(this.blendSrc=t.blendSrc),t.blendDst!==void 0&&(this.blendDst=t.blendDst),t.blendEquation!==void 0&&(this.blendEquation=t.blendEquation),t.blendSrcAlpha!==void 0&&(this.blendSrcAlpha=t.blendSrcAlpha),t.blendDstAlpha!==void 0&&(this.blendDstAlpha=t.blendDstAlpha),t.blendEquationAlpha!==void 0&&(this.blendEquationAlpha=t.blendEquationAlpha),t.blendColor!==void 0&&this.blendColor!==void 0&&this.blendColor.setHex(t.blendColor),t.blendAlpha!==void 0&&(this.blendAlpha=t.blendAlpha),t.stencilWriteMask!==void 0&&(this.stencilWriteMask=t.stencilWriteMask),t.stencilFunc!==void 0&&(this.stencilFunc=t.stencilFunc),t.stencilRef!==void 0&&(this.stencilRef=t.stencilRef),t.stencilFuncMask!==void 0&&(this.stencilFuncMask=t.stencilFuncMask),t.stencilFail!==void 0&&(this.stencilFail=t.stencilFail),t.stencilZFail!==void 0&&(this.stencilZFail=t.stencilZFail),t.stencilZPass!==void 0&&(this.stencilZPass=t.stencilZPass),t.stencilWrite!==void 0&&(this.stencilWrite=t.stencilWrite),t.wireframe!==void 0&&(this.wireframe=t.wireframe),t.wireframeLinewidth!==void 0&&(this.wireframeLinewidth=t.wireframeLinewidth),t.wireframeLinecap!==void 0&&(this.wireframeLinecap=t.wireframeLinecap),t.wireframeLinejoin!==void 0&&(this.wireframeLinejoin=t.wireframeLinejoin),t.rotation!==void 0&&(this.rotation=t.rotation),t.linewidth!==void 0&&(this.linewidth=t.linewidth),t.linecap!==void 0&&(this.linecap=t.linecap),t.linejoin!==void 0&&(this.linejoin=t.linejoin),t.dashSize!==void 0&&(this.dashSize=t.dashSize),t.gapSize!==void 0&&(this.gapSize=t.gapSize),t.scale!==void 0&&(this.scale=t.scale),t.polygonOffset!==void 0&&(this.polygonOffset=t.polygonOffset),t.polygonOffsetFactor!==void 0&&(this.polygonOffsetFactor=t.polygonOffsetFactor),t.polygonOffsetUnits!==void 0&&(this.polygonOffsetUnits=t.polygonOffsetUnits),t.dithering!==void 0&&(this.dithering=t.dithering),t.alphaToCoverage!==void 0&&(this.alphaToCoverage=t.alphaToCoverage),t.premultipliedAlpha!==void 0&&(this.premultipliedAlpha=t.premultipliedAlpha),t.forceSinglePass!==void 0&&(this.forceSinglePass=t.forceSinglePass),t.allowOverride!==void 0&&(this.allowOverride=t.allowOverride),t.visible!==void 0&&(this.visible=t.visible),t.toneMapped!==void 0&&(this.toneMapped=t.toneMapped),t.userData!==void 0&&(this.userData=t.userData),t.vertexColors!==void 0&&(typeof t.vertexColors=="number"?this.vertexColors=t.vertexColors>0:this.vertexColors=t.vertexColors),t.size!==void 0&&(this.size=t.size),t.sizeAttenuation!==void 0&&(this.sizeAttenuation=t.sizeAttenuation),t.map!==void 0&&(this.map=e[t.map]||null),t.matcap!==void 0&&(this.matcap=e[t.matcap]||null),t.alphaMap!==void 0&&(this.alphaMap=e[t.alphaMap]||null),t.bumpMap!==void 0&&(this.bumpMap=e[t.bumpMap]||null),t.bumpScale!==void 0&&(this.bumpScale=t.bumpScale),t.normalMap!==void 0&&(this.normalMap=e[t.normalMap]||null),t.normalMapType!==void 0&&(this.normalMapType=t.normalMapType),t.normalScale!==void 0){let i=t.normalScale;Array.isArray(i)===!1&&(i=[i,i]),this.normalScale=new ht().fromArray(i)}return t.displacementMap!==void 0&&(this.displacementMap=e[t.displacementMap]||null),t.displacementScale!==void 0&&(this.displacementScale=t.displacementScale),t.displacementBias!==void 0&&(this.displacementBias=t.displacementBias),t.roughnessMap!==void 0&&(this.roughnessMap=e[t.roughnessMap]||null),t.metalnessMap!==void 0&&(this.metalnessMap=e[t.metalnessMap]||null),t.emissiveMap!==void 0&&(this.emissiveMap=e[t.emissiveMap]||null),t.emissiveIntensity!==void 0&&(this.emissiveIntensity=t.emissiveIntensity),t.specularMap!==void 0&&(this.specularMap=e[t.specularMap]||null),t.specularIntensityMap!==void 0&&(this.specularIntensityMap=e[t.specularIntensityMap]||null),t.specularColorMap!==void 0&&(this.specularColorMap=e[t.specularColorMap]||null),t.envMap!==void 0&&(this.envMap=e[t.envMap]||null),t.envMapRotation!==void 0&&this.envMapRotation.fromArray(t.envMapRotation),t.envMapIntensity!==void 0&&(this.envMapIntensity=t.envMapIntensity),t.reflectivity!==void 0&&(this.reflectivity=t.reflectivity),t.refractionRatio!==void 0&&(this.refractionRatio=t.refractionRatio),t.lightMap!==void 0&&(this.lightMap=e[t.lightMap]||null),t.lightMapIntensity!==void 0&&(this.lightMapIntensity=t.lightMapIntensity),t.aoMap!==void 0&&(this.aoMap=e[t.aoMap]||null),t.aoMapIntensity!==void 0&&(this.aoMapIntensity=t.aoMapIntensity),t.gradientMap!==void 0&&(this.gradientMap=e[t.gradientMap]||null),t.clearcoatMap!==void 0&&(this.clearcoatMap=e[t.clearcoatMap]||null),t.clearcoatRoughnessMap!==void 0&&(this.clearcoatRoughnessMap=e[t.clearcoatRoughnessMap]||null),t.clearcoatNormalMap!==void 0&&(this.clearcoatNormalMap=e[t.clearcoatNormalMap]||null),t.clearcoatNormalScale!==void 0&&(this.clearcoatNormalScale=new ht().fromArray(t.clearcoatNormalScale)),t.diffuseRoughnessMap!==void 0&&(this.diffuseRoughnessMap=e[t.diffuseRoughnessMap]||null),t.iridescenceMap!==void 0&&(this.iridescenceMap=e[t.iridescenceMap]||null),t.iridescenceThicknessMap!==void 0&&(this.iridescenceThicknessMap=e[t.iridescenceThicknessMap]||null),t.transmissionMap!==void 0&&(this.transmissionMap=e[t.transmissionMap]||null),t.thicknessMap!==void 0&&(this.thicknessMap=e[t.thicknessMap]||null),t.anisotropyMap!==void 0&&(this.anisotropyMap=e[t.anisotropyMap]||null),t.sheenColorMap!==void 0&&(this.sheenColorMap=e[t.sheenColorMap]||null),t.sheenRoughnessMap!==void 0&&(this.sheenRoughnessMap=e[t.sheenRoughnessMap]||null),this}clone(){return new this.constructor().copy(this)}copy(t){this.name=t.name,this.blending=t.blending,this.side=t.side,this.vertexColors=t.vertexColors,this.opacity=t.opacity,this.transparent=t.transparent,this.blendSrc=t.blendSrc,this.blendDst=t.blendDst,this.blendEquation=t.blendEquation,this.blendSrcAlpha=t.blendSrcAlpha,this.blendDstAlpha=t.blendDstAlpha,this.blendEquationAlpha=t.blendEquationAlpha,this.blendColor.copy(t.blendColor),this.blendAlpha=t.blendAlpha,this.depthFunc=t.depthFunc,this.depthTest=t.depthTest,this.depthWrite=t.depthWrite,this.stencilWriteMask=t.stencilWriteMask,this.stencilFunc=t.stencilFunc,this.stencilRef=t.stencilRef,this.stencilFuncMask=t.stencilFuncMask,this.stencilFail=t.stencilFail,this.stencilZFail=t.stencilZFail,this.stencilZPass=t.stencilZPass,this.stencilWrite=t.stencilWrite;let e=t.clippingPlanes,i=null;if(e!==null){let s=e.length;i=new Array(s);for(let r=0;r!==s;++r)i[r]=e[r].clone()}return this.clippingPlanes=i,this.clipIntersection=t.clipIntersection,this.clipShadows=t.clipShadows,this.shadowSide=t.shadowSide,this.colorWrite=t.colorWrite,this.precision=t.precision,this.polygonOffset=t.polygonOffset,this.polygonOffsetFactor=t.polygonOffsetFactor,this.polygonOffsetUnits=t.polygonOffsetUnits,this.dithering=t.dithering,this.alphaTest=t.alphaTest,this.alphaHash=t.alphaHash,this.alphaToCoverage=t.alphaToCoverage,this.premultipliedAlpha=t.premultipliedAlpha,this.forceSinglePass=t.forceSinglePass,this.allowOverride=t.allowOverride,this.visible=t.visible,this.toneMapped=t.toneMapped,this.userData=JSON.parse(JSON.stringify(t.userData)),this}dispose(){this.dispatchEvent({type:"dispose"})}set needsUpdate(t){t===!0&&this.version++}};var ui=new P,ef=new P,sl=new P,rl=new P,gi=class{constructor(t=new P,e=new P(0,0,-1)){this.origin=t,this.direction=e}set(t,e){return this.origin.copy(t),this.direction.copy(e),this}copy(t){return this.origin.copy(t.origin),this.direction.copy(t.direction),this}at(t,e){return e.copy(this.origin).addScaledVector(this.direction,t)}lookAt(t){return this.direction.copy(t).sub(this.origin).normalize(),this}recast(t){return this.origin.copy(this.at(t,ui)),this}closestPointToPoint(t,e){e.subVectors(t,this.origin);let i=e.dot(this.direction);return i<0?e.copy(this.origin):e.copy(this.origin).addScaledVector(this.direction,i)}distanceToPoint(t){return Math.sqrt(this.distanceSqToPoint(t))}distanceSqToPoint(t){let e=ui.subVectors(t,this.origin).dot(this.direction);return e<0?this.origin.distanceToSquared(t):(ui.copy(this.origin).addScaledVector(this.direction,e),ui.distanceToSquared(t))}distanceSqToSegment(t,e,i,s){ef.copy(t).add(e).multiplyScalar(.5),sl.copy(e).sub(t).normalize(),rl.copy(this.origin).sub(ef);let r=t.distanceTo(e)*.5,o=-this.direction.dot(sl),a=rl.dot(this.direction),c=-rl.dot(sl),l=rl.lengthSq(),h=Math.abs(1-o*o),u,f,d,m;if(h>0)if(u=o*c-a,f=o*a-c,m=r*h,u>=0)if(f>=-m)if(f<=m){let _=1/h;u*=_,f*=_,d=u*(u+o*f+2*a)+f*(o*u+f+2*c)+l}else f=r,u=Math.max(0,-(o*f+a)),d=-u*u+f*(f+2*c)+l;else f=-r,u=Math.max(0,-(o*f+a)),d=-u*u+f*(f+2*c)+l;else f<=-m?(u=Math.max(0,-(-o*r+a)),f=u>0?-r:Math.min(Math.max(-r,-c),r),d=-u*u+f*(f+2*c)+l):f<=m?(u=0,f=Math.min(Math.max(-r,-c),r),d=f*(f+2*c)+l):(u=Math.max(0,-(o*r+a)),f=u>0?r:Math.min(Math.max(-r,-c),r),d=-u*u+f*(f+2*c)+l);else f=o>0?-r:r,u=Math.max(0,-(o*f+a)),d=-u*u+f*(f+2*c)+l;return i&&i.copy(this.origin).addScaledVector(this.direction,u),s&&s.copy(ef).addScaledVector(sl,f),d}intersectSphere(t,e){if(t.radius<0)return null;ui.subVectors(t.center,this.origin);let i=ui.dot(this.direction),s=ui.dot(ui)-i*i,r=t.radius*t.radius;if(s>r)return null;let o=Math.sqrt(r-s),a=i-o,c=i+o;return c<0?null:a<0?this.at(c,e):this.at(a,e)}intersectsSphere(t){return t.radius<0?!1:this.distanceSqToPoint(t.center)<=t.radius*t.radius}distanceToPlane(t){let e=t.normal.dot(this.direction);if(e===0)return t.distanceToPoint(this.origin)===0?0:null;let i=-(this.origin.dot(t.normal)+t.constant)/e;return i>=0?i:null}intersectPlane(t,e){let i=this.distanceToPlane(t);return i===null?null:this.at(i,e)}intersectsPlane(t){let e=t.distanceToPoint(this.origin);return e===0||t.normal.dot(this.direction)*e<0}intersectBox(t,e){let i,s,r,o,a,c,l=1/this.direction.x,h=1/this.direction.y,u=1/this.direction.z,f=this.origin;return l>=0?(i=(t.min.x-f.x)*l,s=(t.max.x-f.x)*l):(i=(t.max.x-f.x)*l,s=(t.min.x-f.x)*l),h>=0?(r=(t.min.y-f.y)*h,o=(t.max.y-f.y)*h):(r=(t.max.y-f.y)*h,o=(t.min.y-f.y)*h),i>o||r>s||((r>i||isNaN(i))&&(i=r),(o<s||isNaN(s))&&(s=o),u>=0?(a=(t.min.z-f.z)*u,c=(t.max.z-f.z)*u):(a=(t.max.z-f.z)*u,c=(t.min.z-f.z)*u),i>c||a>s)||((a>i||i!==i)&&(i=a),(c<s||s!==s)&&(s=c),s<0)?null:this.at(i>=0?i:s,e)}intersectsBox(t){return this.intersectBox(t,ui)!==null}intersectTriangle(t,e,i,s,r){let o=this.origin,a=this.direction,c=a.x,l=a.y,h=a.z,u=t.x-o.x,f=t.y-o.y,d=t.z-o.z,m=e.x-o.x,_=e.y-o.y,p=e.z-o.z,g=i.x-o.x,x=i.y-o.y,b=i.z-o.z,v=Math.abs(c),w=Math.abs(l),E=Math.abs(h),y,M,L,R,D,N,B,C,z,$,G,st;if(v>=w&&v>=E?(L=c,N=u,z=m,st=g,c>=0?(y=l,M=h,R=f,D=d,B=_,C=p,$=x,G=b):(y=h,M=l,R=d,D=f,B=p,C=_,$=b,G=x)):w>=E?(L=l,N=f,z=_,st=x,l>=0?(y=h,M=c,R=d,D=u,B=p,C=m,$=b,G=g):(y=c,M=h,R=u,D=d,B=m,C=p,$=g,G=b)):(L=h,N=d,z=p,st=b,h>=0?(y=c,M=l,R=u,D=f,B=m,C=_,$=g,G=x):(y=l,M=c,R=f,D=u,B=_,C=m,$=x,G=g)),L===0)return null;let X=y/L,Z=M/L,it=1/L,Mt=R-X*N,Dt=D-Z*N,j=B-X*z,W=C-Z*z,et=$-X*st,ot=G-Z*st,O=et*W-ot*j,K=Mt*ot-Dt*et,Tt=j*Dt-W*Mt;if(s){if(O<0||K<0||Tt<0)return null}else if((O<0||K<0||Tt<0)&&(O>0||K>0||Tt>0))return null;let ct=O+K+Tt;if(ct===0)return null;let Rt=it*(O*N+K*z+Tt*st);return(ct>0?Rt<0:Rt>0)?null:this.at(Rt/ct,r)}applyMatrix4(t){return this.origin.applyMatrix4(t),this.direction.transformDirection(t),this}equals(t){return t.origin.equals(this.origin)&&t.direction.equals(this.direction)}clone(){return new this.constructor().copy(this)}},fn=class extends Yn{constructor(t){super(),this.isMeshBasicMaterial=!0,this.type="MeshBasicMaterial",this.color=new Gt(16777215),this.map=null,this.lightMap=null,this.lightMapIntensity=1,this.aoMap=null,this.aoMapIntensity=1,this.specularMap=null,this.alphaMap=null,this.envMap=null,this.envMapRotation=new mi,this.combine=mc,this.reflectivity=1,this.refractionRatio=.98,this.wireframe=!1,this.wireframeLinewidth=1,this.wireframeLinecap="round",this.wireframeLinejoin="round",this.fog=!0,this.setValues(t)}copy(t){return super.copy(t),this.color.copy(t.color),this.map=t.map,this.lightMap=t.lightMap,this.lightMapIntensity=t.lightMapIntensity,this.aoMap=t.aoMap,this.aoMapIntensity=t.aoMapIntensity,this.specularMap=t.specularMap,this.alphaMap=t.alphaMap,this.envMap=t.envMap,this.envMapRotation.copy(t.envMapRotation),this.combine=t.combine,this.reflectivity=t.reflectivity,this.refractionRatio=t.refractionRatio,this.wireframe=t.wireframe,this.wireframeLinewidth=t.wireframeLinewidth,this.wireframeLinecap=t.wireframeLinecap,this.wireframeLinejoin=t.wireframeLinejoin,this.fog=t.fog,this}},wg=new re,Ss=new gi,ol=new An,Ag=new P,al=new P,ll=new P,cl=new P,nf=new P,hl=new P,Eg=new P,ul=new P,de=class extends De{constructor(t=new ae,e=new fn){super(),this.isMesh=!0,this.type="Mesh",this.geometry=t,this.material=e,this.morphTargetDictionary=void 0,this.morphTargetInfluences=void 0,this.count=1,this.updateMorphTargets()}copy(t,e){return super.copy(t,e),t.morphTargetInfluences!==void 0?this.morphTargetInfluences=t.morphTargetInfluences.slice():this.morphTargetInfluences=void 0,t.morphTargetDictionary!==void 0?this.morphTargetDictionary=Object.assign({},t.morphTargetDictionary):this.morphTargetDictionary=void 0,this.material=Array.isArray(t.material)?t.material.slice():t.material,this.geometry=t.geometry,this}updateMorphTargets(){let e=this.geometry.morphAttributes,i=Object.keys(e);if(i.length>0){let s=e[i[0]];if(s!==void 0){this.morphTargetInfluences=[],this.morphTargetDictionary={};for(let r=0,o=s.length;r<o;r++){let a=s[r].name||String(r);this.morphTargetInfluences.push(0),this.morphTargetDictionary[a]=r}}}}getVertexPosition(t,e){let i=this.geometry,s=i.attributes.position,r=i.morphAttributes.position,o=i.morphTargetsRelative;e.fromBufferAttribute(s,t);let a=this.morphTargetInfluences;if(r&&a){hl.set(0,0,0);for(let c=0,l=r.length;c<l;c++){let h=a[c],u=r[c];h!==0&&(nf.fromBufferAttribute(u,t),o?hl.addScaledVector(nf,h):hl.addScaledVector(nf.sub(e),h))}e.add(hl)}return e}intersectsFrustum(t){return t.intersectsObject(this)}raycast(t,e){let i=this.geometry,s=this.material,r=this.matrixWorld;s!==void 0&&(i.boundingSphere===null&&i.computeBoundingSphere(),ol.copy(i.boundingSphere),ol.applyMatrix4(r),Ss.copy(t.ray).recast(t.near),!(ol.containsPoint(Ss.origin)===!1&&(Ss.intersectSphere(ol,Ag)===null||Ss.origin.distanceToSquared(Ag)>(t.far-t.near)**2))&&(wg.copy(r).invert(),Ss.copy(t.ray).applyMatrix4(wg),!(i.boundingBox!==null&&Ss.intersectsBox(i.boundingBox)===!1)&&this._computeIntersections(t,e,Ss)))}_computeIntersections(t,e,i){let s,r=this.geometry,o=this.material,a=r.index,c=r.attributes.position,l=r.attributes.uv,h=r.attributes.uv1,u=r.attributes.normal,f=r.groups,d=r.drawRange;if(a!==null)if(Array.isArray(o))for(let m=0,_=f.length;m<_;m++){let p=f[m],g=o[p.materialIndex],x=Math.max(p.start,d.start),b=Math.min(a.count,Math.min(p.start+p.count,d.start+d.count));for(let v=x,w=b;v<w;v+=3){let E=a.getX(v),y=a.getX(v+1),M=a.getX(v+2);s=fl(this,g,t,i,l,h,u,E,y,M),s&&(s.faceIndex=Math.floor(v/3),s.face.materialIndex=p.materialIndex,e.push(s))}}else{let m=Math.max(0,d.start),_=Math.min(a.count,d.start+d.count);for(let p=m,g=_;p<g;p+=3){let x=a.getX(p),b=a.getX(p+1),v=a.getX(p+2);s=fl(this,o,t,i,l,h,u,x,b,v),s&&(s.faceIndex=Math.floor(p/3),e.push(s))}}else if(c!==void 0)if(Array.isArray(o))for(let m=0,_=f.length;m<_;m++){let p=f[m],g=o[p.materialIndex],x=Math.max(p.start,d.start),b=Math.min(c.count,Math.min(p.start+p.count,d.start+d.count));for(let v=x,w=b;v<w;v+=3){let E=v,y=v+1,M=v+2;s=fl(this,g,t,i,l,h,u,E,y,M),s&&(s.faceIndex=Math.floor(v/3),s.face.materialIndex=p.materialIndex,e.push(s))}}else{let m=Math.max(0,d.start),_=Math.min(c.count,d.start+d.count);for(let p=m,g=_;p<g;p+=3){let x=p,b=p+1,v=p+2;s=fl(this,o,t,i,l,h,u,x,b,v),s&&(s.faceIndex=Math.floor(p/3),e.push(s))}}}};function ub(n,t,e,i,s,r,o,a){let c;if(t.side===Ue?c=i.intersectTriangle(o,r,s,!0,a):c=i.intersectTriangle(s,r,o,t.side===Zi,a),c===null)return null;ul.copy(a),ul.applyMatrix4(n.matrixWorld);let l=e.ray.origin.distanceTo(ul);return l<e.near||l>e.far?null:{distance:l,point:ul.clone(),object:n}}function fl(n,t,e,i,s,r,o,a,c,l){n.getVertexPosition(a,al),n.getVertexPosition(c,ll),n.getVertexPosition(l,cl);let h=ub(n,t,e,i,al,ll,cl,Eg);if(h){let u=new P;fi.getBarycoord(Eg,al,ll,cl,u),s&&(h.uv=fi.getInterpolatedAttribute(s,a,c,l,u,new ht)),r&&(h.uv1=fi.getInterpolatedAttribute(r,a,c,l,u,new ht)),o&&(h.normal=fi.getInterpolatedAttribute(o,a,c,l,u,new P),h.normal.dot(i.direction)>0&&h.normal.multiplyScalar(-1));let f={a,b:c,c:l,normal:new P,materialIndex:0};fi.getNormal(al,ll,cl,f.normal),h.face=f,h.barycoord=u}return h}var Hl=class extends Qe{constructor(t=null,e=1,i=1,s,r,o,a,c,l=Pe,h=Pe,u,f){super(null,o,a,c,l,h,s,r,u,f),this.isDataTexture=!0,this.image={data:t,width:e,height:i},this.generateMipmaps=!1,this.flipY=!1,this.unpackAlignment=1}};var ws=new An,fb=new ht(.5,.5),dl=new P,Vi=class{constructor(t=new Je,e=new Je,i=new Je,s=new Je,r=new Je,o=new Je){this.planes=[t,e,i,s,r,o]}set(t,e,i,s,r,o){let a=this.planes;return a[0].copy(t),a[1].copy(e),a[2].copy(i),a[3].copy(s),a[4].copy(r),a[5].copy(o),this}copy(t){let e=this.planes;for(let i=0;i<6;i++)e[i].copy(t.planes[i]);return this}setFromProjectionMatrix(t,e=wn,i=!1){let s=this.planes,r=t.elements,o=r[0],a=r[1],c=r[2],l=r[3],h=r[4],u=r[5],f=r[6],d=r[7],m=r[8],_=r[9],p=r[10],g=r[11],x=r[12],b=r[13],v=r[14],w=r[15];if(s[0].setComponents(l-o,d-h,g-m,w-x).normalize(),s[1].setComponents(l+o,d+h,g+m,w+x).normalize(),s[2].setComponents(l+a,d+u,g+_,w+b).normalize(),s[3].setComponents(l-a,d-u,g-_,w-b).normalize(),i)s[4].setComponents(c,f,p,v).normalize(),s[5].setComponents(l-c,d-f,g-p,w-v).normalize();else if(s[4].setComponents(l-c,d-f,g-p,w-v).normalize(),e===wn)s[5].setComponents(l+c,d+f,g+p,w+v).normalize();else if(e===vr)s[5].setComponents(c,f,p,v).normalize();else throw new Error("THREE.Frustum.setFromProjectionMatrix(): Invalid coordinate system: "+e);return this}intersectsObject(t){if(t.boundingSphere!==void 0)t.boundingSphere===null&&t.computeBoundingSphere(),ws.copy(t.boundingSphere).applyMatrix4(t.matrixWorld);else{let e=t.geometry;e.boundingSphere===null&&e.computeBoundingSphere(),ws.copy(e.boundingSphere).applyMatrix4(t.matrixWorld)}return this.intersectsSphere(ws)}intersectsSprite(t){ws.center.set(0,0,0);let e=fb.distanceTo(t.center);return ws.radius=.7071067811865476+e,ws.applyMatrix4(t.matrixWorld),this.intersectsSphere(ws)}intersectsSphere(t){let e=this.planes,i=t.center,s=-t.radius;for(let r=0;r<6;r++)if(e[r].distanceToPoint(i)<s)return!1;return!0}intersectsBox(t){let e=this.planes;for(let i=0;i<6;i++){let s=e[i];if(dl.x=s.normal.x>0?t.max.x:t.min.x,dl.y=s.normal.y>0?t.max.y:t.min.y,dl.z=s.normal.z>0?t.max.z:t.min.z,s.distanceToPoint(dl)<0)return!1}return!0}containsPoint(t){let e=this.planes;for(let i=0;i<6;i++)if(e[i].distanceToPoint(t)<0)return!1;return!0}clone(){return new this.constructor().copy(this)}},Tg=new re,Wl=class n{constructor(){this.coordinateSystem=wn,this._frustums=[],this._count=0}setFromArrayCamera(t){let e=t.cameras,i=this._frustums;for(let s=0;s<e.length;s++){let r=e[s];Tg.multiplyMatrices(r.projectionMatrix,r.matrixWorldInverse),i[s]===void 0&&(i[s]=new Vi),i[s].setFromProjectionMatrix(Tg,r.coordinateSystem,r.reversedDepth)}return this._count=e.length,this}getFrustum(t){return this._frustums[t]}intersectsObject(t){let e=this._frustums;for(let i=0;i<this._count;i++)if(e[i].intersectsObject(t))return!0;return!1}intersectsSprite(t){let e=this._frustums;for(let i=0;i<this._count;i++)if(e[i].intersectsSprite(t))return!0;return!1}intersectsSphere(t){let e=this._frustums;for(let i=0;i<this._count;i++)if(e[i].intersectsSphere(t))return!0;return!1}intersectsBox(t){let e=this._frustums;for(let i=0;i<this._count;i++)if(e[i].intersectsBox(t))return!0;return!1}containsPoint(t){let e=this._frustums;for(let i=0;i<this._count;i++)if(e[i].containsPoint(t))return!0;return!1}copy(t){this.coordinateSystem=t.coordinateSystem;let e=this._frustums,i=t._frustums;for(let s=0;s<t._count;s++)e[s]===void 0&&(e[s]=new Vi),e[s].copy(i[s]);return this._count=t._count,this}clone(){return new n().copy(this)}};var Zn=class extends Yn{constructor(t){super(),this.isLineBasicMaterial=!0,this.type="LineBasicMaterial",this.color=new Gt(16777215),this.map=null,this.linewidth=1,this.linecap="round",this.linejoin="round",this.fog=!0,this.setValues(t)}copy(t){return super.copy(t),this.color.copy(t.color),this.map=t.map,this.linewidth=t.linewidth,this.linecap=t.linecap,this.linejoin=t.linejoin,this.fog=t.fog,this}},Xl=new P,$l=new P,Cg=new re,uo=new gi,pl=new An,sf=new P,Rg=new P,ql=class extends De{constructor(t=new ae,e=new Zn){super(),this.isLine=!0,this.type="Line",this.geometry=t,this.material=e,this.morphTargetDictionary=void 0,this.morphTargetInfluences=void 0,this.updateMorphTargets()}copy(t,e){return super.copy(t,e),t.morphTargetInfluences!==void 0?this.morphTargetInfluences=t.morphTargetInfluences.slice():this.morphTargetInfluences=void 0,t.morphTargetDictionary!==void 0?this.morphTargetDictionary=Object.assign({},t.morphTargetDictionary):this.morphTargetDictionary=void 0,this.material=Array.isArray(t.material)?t.material.slice():t.material,this.geometry=t.geometry,this}computeLineDistances(){let t=this.geometry;if(t.index===null){let e=t.attributes.position,i=[0];for(let s=1,r=e.count;s<r;s++)Xl.fromBufferAttribute(e,s-1),$l.fromBufferAttribute(e,s),i[s]=i[s-1],i[s]+=Xl.distanceTo($l);t.setAttribute("lineDistance",new Vt(i,1))}else Nt("Line.computeLineDistances(): Computation only possible with non-indexed BufferGeometry.");return this}intersectsFrustum(t){return t.intersectsObject(this)}raycast(t,e){let i=this.geometry,s=this.matrixWorld,r=t.params.Line.threshold,o=i.drawRange;if(i.boundingSphere===null&&i.computeBoundingSphere(),pl.copy(i.boundingSphere),pl.applyMatrix4(s),pl.radius+=r,t.ray.intersectsSphere(pl)===!1)return;Cg.copy(s).invert(),uo.copy(t.ray).applyMatrix4(Cg);let a=r/((this.scale.x+this.scale.y+this.scale.z)/3),c=a*a,l=this.isLineSegments?2:1,h=i.index,f=i.attributes.position;if(h!==null){let d=Math.max(0,o.start),m=Math.min(h.count,o.start+o.count);for(let _=d,p=m-1;_<p;_+=l){let g=h.getX(_),x=h.getX(_+1),b=ml(this,t,uo,c,g,x,_);b&&e.push(b)}if(this.isLineLoop){let _=h.getX(m-1),p=h.getX(d),g=ml(this,t,uo,c,_,p,m-1);g&&e.push(g)}}else{let d=Math.max(0,o.start),m=Math.min(f.count,o.start+o.count);for(let _=d,p=m-1;_<p;_+=l){let g=ml(this,t,uo,c,_,_+1,_);g&&e.push(g)}if(this.isLineLoop){let _=ml(this,t,uo,c,m-1,d,m-1);_&&e.push(_)}}}updateMorphTargets(){let e=this.geometry.morphAttributes,i=Object.keys(e);if(i.length>0){let s=e[i[0]];if(s!==void 0){this.morphTargetInfluences=[],this.morphTargetDictionary={};for(let r=0,o=s.length;r<o;r++){let a=s[r].name||String(r);this.morphTargetInfluences.push(0),this.morphTargetDictionary[a]=r}}}}};function ml(n,t,e,i,s,r,o){let a=n.geometry.attributes.position;if(Xl.fromBufferAttribute(a,s),$l.fromBufferAttribute(a,r),e.distanceSqToSegment(Xl,$l,sf,Rg)>i)return;sf.applyMatrix4(n.matrixWorld);let l=t.ray.origin.distanceTo(sf);if(!(l<t.near||l>t.far))return{distance:l,point:Rg.clone().applyMatrix4(n.matrixWorld),index:o,face:null,faceIndex:null,barycoord:null,object:n}}var Pg=new P,Ig=new P,_i=class extends ql{constructor(t,e){super(t,e),this.isLineSegments=!0,this.type="LineSegments"}computeLineDistances(){let t=this.geometry;if(t.index===null){let e=t.attributes.position,i=[];for(let s=0,r=e.count;s<r;s+=2)Pg.fromBufferAttribute(e,s),Ig.fromBufferAttribute(e,s+1),i[s]=s===0?0:i[s-1],i[s+1]=i[s]+Pg.distanceTo(Ig);t.setAttribute("lineDistance",new Vt(i,1))}else Nt("LineSegments.computeLineDistances(): Computation only possible with non-indexed BufferGeometry.");return this}};var Er=class extends Yn{constructor(t){super(),this.isPointsMaterial=!0,this.type="PointsMaterial",this.color=new Gt(16777215),this.map=null,this.alphaMap=null,this.size=1,this.sizeAttenuation=!0,this.fog=!0,this.setValues(t)}copy(t){return super.copy(t),this.color.copy(t.color),this.map=t.map,this.alphaMap=t.alphaMap,this.size=t.size,this.sizeAttenuation=t.sizeAttenuation,this.fog=t.fog,this}},Lg=new re,mf=new gi,gl=new An,_l=new P,To=class extends De{constructor(t=new ae,e=new Er){super(),this.isPoints=!0,this.type="Points",this.geometry=t,this.material=e,this.morphTargetDictionary=void 0,this.morphTargetInfluences=void 0,this.updateMorphTargets()}copy(t,e){return super.copy(t,e),t.morphTargetInfluences!==void 0?this.morphTargetInfluences=t.morphTargetInfluences.slice():this.morphTargetInfluences=void 0,t.morphTargetDictionary!==void 0?this.morphTargetDictionary=Object.assign({},t.morphTargetDictionary):this.morphTargetDictionary=void 0,this.material=Array.isArray(t.material)?t.material.slice():t.material,this.geometry=t.geometry,this}intersectsFrustum(t){return t.intersectsObject(this)}raycast(t,e){let i=this.geometry,s=this.matrixWorld,r=t.params.Points.threshold,o=i.drawRange;if(i.boundingSphere===null&&i.computeBoundingSphere(),gl.copy(i.boundingSphere),gl.applyMatrix4(s),gl.radius+=r,t.ray.intersectsSphere(gl)===!1)return;Lg.copy(s).invert(),mf.copy(t.ray).applyMatrix4(Lg);let a=r/((this.scale.x+this.scale.y+this.scale.z)/3),c=a*a,l=i.index,u=i.attributes.position;if(l!==null){let f=Math.max(0,o.start),d=Math.min(l.count,o.start+o.count);for(let m=f,_=d;m<_;m++){let p=l.getX(m);_l.fromBufferAttribute(u,p),Ng(_l,p,c,s,t,e,this)}}else{let f=Math.max(0,o.start),d=Math.min(u.count,o.start+o.count);for(let m=f,_=d;m<_;m++)_l.fromBufferAttribute(u,m),Ng(_l,m,c,s,t,e,this)}}updateMorphTargets(){let e=this.geometry.morphAttributes,i=Object.keys(e);if(i.length>0){let s=e[i[0]];if(s!==void 0){this.morphTargetInfluences=[],this.morphTargetDictionary={};for(let r=0,o=s.length;r<o;r++){let a=s[r].name||String(r);this.morphTargetInfluences.push(0),this.morphTargetDictionary[a]=r}}}}};function Ng(n,t,e,i,s,r,o){let a=mf.distanceSqToPoint(n);if(a<e){let c=new P;mf.closestPointToPoint(n,c),c.applyMatrix4(i);let l=s.ray.origin.distanceTo(c);if(l<s.near||l>s.far)return;r.push({distance:l,distanceToRay:Math.sqrt(a),point:c,index:t,face:null,faceIndex:null,barycoord:null,object:o})}}var Co=class extends Qe{constructor(t=[],e=Ls,i,s,r,o,a,c,l,h){super(t,e,i,s,r,o,a,c,l,h),this.isCubeTexture=!0,this.flipY=!1}get images(){return this.image}set images(t){this.image=t}},Tr=class extends Qe{constructor(t,e,i,s,r,o,a,c,l){super(t,e,i,s,r,o,a,c,l),this.isCanvasTexture=!0,this.needsUpdate=!0}};var xi=class extends Qe{constructor(t,e,i=kn,s,r,o,a=Pe,c=Pe,l,h=pi,u=1){if(h!==pi&&h!==Mi)throw new Error("THREE.DepthTexture: format must be either THREE.DepthFormat or THREE.DepthStencilFormat");let f={width:t,height:e,depth:u};super(f,s,r,o,a,c,h,i,l),this.isDepthTexture=!0,this.flipY=!1,this.generateMipmaps=!1,this.compareFunction=null}copy(t){return super.copy(t),this.source=new Sr(Object.assign({},t.image)),this.compareFunction=t.compareFunction,this}toJSON(t){let e=super.toJSON(t);return e.compareFunction=this.compareFunction,e}},Ro=class extends xi{constructor(t,e=kn,i=Ls,s,r,o=Pe,a=Pe,c,l=pi){let h={width:t,height:t,depth:1},u=[h,h,h,h,h,h];super(t,t,e,i,s,r,o,a,c,l),this.image=u,this.isCubeDepthTexture=!0,this.isCubeTexture=!0}get images(){return this.image}set images(t){this.image=t}},Po=class extends Qe{constructor(t=null){super(),this.sourceTexture=t,this.isExternalTexture=!0}copy(t){return super.copy(t),this.sourceTexture=t.sourceTexture,this}},yi=class n extends ae{constructor(t=1,e=1,i=1,s=1,r=1,o=1){super(),this.type="BoxGeometry",this.parameters={width:t,height:e,depth:i,widthSegments:s,heightSegments:r,depthSegments:o};let a=this;s=Math.floor(s),r=Math.floor(r),o=Math.floor(o);let c=[],l=[],h=[],u=[],f=0,d=0;m("z","y","x",-1,-1,i,e,t,o,r,0),m("z","y","x",1,-1,i,e,-t,o,r,1),m("x","z","y",1,1,t,i,e,s,o,2),m("x","z","y",1,-1,t,i,-e,s,o,3),m("x","y","z",1,-1,t,e,i,s,r,4),m("x","y","z",-1,-1,t,e,-i,s,r,5),this.setIndex(c),this.setAttribute("position",new Vt(l,3)),this.setAttribute("normal",new Vt(h,3)),this.setAttribute("uv",new Vt(u,2));function m(_,p,g,x,b,v,w,E,y,M,L){let R=v/y,D=w/M,N=v/2,B=w/2,C=E/2,z=y+1,$=M+1,G=0,st=0,X=new P;for(let Z=0;Z<$;Z++){let it=Z*D-B;for(let Mt=0;Mt<z;Mt++){let Dt=Mt*R-N;X[_]=Dt*x,X[p]=it*b,X[g]=C,l.push(X.x,X.y,X.z),X[_]=0,X[p]=0,X[g]=E>0?1:-1,h.push(X.x,X.y,X.z),u.push(Mt/y),u.push(1-Z/M),G+=1}}for(let Z=0;Z<M;Z++)for(let it=0;it<y;it++){let Mt=f+it+z*Z,Dt=f+it+z*(Z+1),j=f+(it+1)+z*(Z+1),W=f+(it+1)+z*Z;c.push(Mt,Dt,W),c.push(Dt,j,W),st+=6}a.addGroup(d,st,L),d+=st,f+=G}}copy(t){return super.copy(t),this.parameters=Object.assign({},t.parameters),this}static fromJSON(t){return new n(t.width,t.height,t.depth,t.widthSegments,t.heightSegments,t.depthSegments)}};var Io=class n extends ae{constructor(t=1,e=32,i=0,s=Math.PI*2){super(),this.type="CircleGeometry",this.parameters={radius:t,segments:e,thetaStart:i,thetaLength:s},e=Math.max(3,e);let r=[],o=[],a=[],c=[],l=new P,h=new ht;o.push(0,0,0),a.push(0,0,1),c.push(.5,.5);for(let u=0,f=3;u<=e;u++,f+=3){let d=i+u/e*s;l.x=t*Math.cos(d),l.y=t*Math.sin(d),o.push(l.x,l.y,l.z),a.push(0,0,1),h.x=(o[f]/t+1)/2,h.y=(o[f+1]/t+1)/2,c.push(h.x,h.y)}for(let u=1;u<=e;u++)r.push(u,u+1,0);this.setIndex(r),this.setAttribute("position",new Vt(o,3)),this.setAttribute("normal",new Vt(a,3)),this.setAttribute("uv",new Vt(c,2))}copy(t){return super.copy(t),this.parameters=Object.assign({},t.parameters),this}static fromJSON(t){return new n(t.radius,t.segments,t.thetaStart,t.thetaLength)}},Gi=class n extends ae{constructor(t=1,e=1,i=1,s=32,r=1,o=!1,a=0,c=Math.PI*2){super(),this.type="CylinderGeometry",this.parameters={radiusTop:t,radiusBottom:e,height:i,radialSegments:s,heightSegments:r,openEnded:o,thetaStart:a,thetaLength:c};let l=this;s=Math.floor(s),r=Math.floor(r);let h=[],u=[],f=[],d=[],m=0,_=[],p=i/2,g=0;x(),o===!1&&(t>0&&b(!0),e>0&&b(!1)),this.setIndex(h),this.setAttribute("position",new Vt(u,3)),this.setAttribute("normal",new Vt(f,3)),this.setAttribute("uv",new Vt(d,2));function x(){let v=new P,w=new P,E=0,y=(e-t)/i;for(let M=0;M<=r;M++){let L=[],R=M/r,D=R*(e-t)+t;for(let N=0;N<=s;N++){let B=N/s,C=B*c+a,z=Math.sin(C),$=Math.cos(C);w.x=D*z,w.y=-R*i+p,w.z=D*$,u.push(w.x,w.y,w.z),v.set(z,y,$).normalize(),f.push(v.x,v.y,v.z),d.push(B,1-R),L.push(m++)}_.push(L)}for(let M=0;M<s;M++)for(let L=0;L<r;L++){let R=_[L][M],D=_[L+1][M],N=_[L+1][M+1],B=_[L][M+1];(t>0||L!==0)&&(h.push(R,D,B),E+=3),(e>0||L!==r-1)&&(h.push(D,N,B),E+=3)}l.addGroup(g,E,0),g+=E}function b(v){let w=m,E=new ht,y=new P,M=0,L=v===!0?t:e,R=v===!0?1:-1;for(let N=1;N<=s;N++)u.push(0,p*R,0),f.push(0,R,0),d.push(.5,.5),m++;let D=m;for(let N=0;N<=s;N++){let C=N/s*c+a,z=Math.cos(C),$=Math.sin(C);y.x=L*$,y.y=p*R,y.z=L*z,u.push(y.x,y.y,y.z),f.push(0,R,0),E.x=z*.5+.5,E.y=$*.5*R+.5,d.push(E.x,E.y),m++}for(let N=0;N<s;N++){let B=w+N,C=D+N;v===!0?h.push(C,C+1,B):h.push(C+1,C,B),M+=3}l.addGroup(g,M,v===!0?1:2),g+=M}}copy(t){return super.copy(t),this.parameters=Object.assign({},t.parameters),this}static fromJSON(t){return new n(t.radiusTop,t.radiusBottom,t.height,t.radialSegments,t.heightSegments,t.openEnded,t.thetaStart,t.thetaLength)}},Lo=class n extends Gi{constructor(t=1,e=1,i=32,s=1,r=!1,o=0,a=Math.PI*2){super(0,t,e,i,s,r,o,a),this.type="ConeGeometry",this.parameters={radius:t,height:e,radialSegments:i,heightSegments:s,openEnded:r,thetaStart:o,thetaLength:a}}static fromJSON(t){return new n(t.radius,t.height,t.radialSegments,t.heightSegments,t.openEnded,t.thetaStart,t.thetaLength)}};var xl=new P,yl=new P,rf=new P,vl=new fi,Cr=class extends ae{constructor(t=null,e=1){if(super(),this.type="EdgesGeometry",this.parameters={geometry:t,thresholdAngle:e},t!==null){let s=Math.pow(10,4),r=Math.cos(gr*e),o=t.getIndex(),a=t.getAttribute("position"),c=o?o.count:a.count,l=[0,0,0],h=["a","b","c"],u=new Array(3),f=new Map,d=[];for(let m=0;m<c;m+=3){o?(l[0]=o.getX(m),l[1]=o.getX(m+1),l[2]=o.getX(m+2)):(l[0]=m,l[1]=m+1,l[2]=m+2);let{a:_,b:p,c:g}=vl;if(_.fromBufferAttribute(a,l[0]),p.fromBufferAttribute(a,l[1]),g.fromBufferAttribute(a,l[2]),vl.getNormal(rf),u[0]=`${Math.round(_.x*s)},${Math.round(_.y*s)},${Math.round(_.z*s)}`,u[1]=`${Math.round(p.x*s)},${Math.round(p.y*s)},${Math.round(p.z*s)}`,u[2]=`${Math.round(g.x*s)},${Math.round(g.y*s)},${Math.round(g.z*s)}`,!(u[0]===u[1]||u[1]===u[2]||u[2]===u[0]))for(let x=0;x<3;x++){let b=(x+1)%3,v=u[x],w=u[b],E=vl[h[x]],y=vl[h[b]],M=`${v}_${w}`,L=`${w}_${v}`,R=f.get(L);R?(rf.dot(R.normal)<=r&&(d.push(E.x,E.y,E.z),d.push(y.x,y.y,y.z)),f.set(L,null)):f.has(M)||f.set(M,{index0:l[x],index1:l[b],normal:rf.clone()})}}for(let m of f.values())if(m){let{index0:_,index1:p}=m;xl.fromBufferAttribute(a,_),yl.fromBufferAttribute(a,p),d.push(xl.x,xl.y,xl.z),d.push(yl.x,yl.y,yl.z)}this.setAttribute("position",new Vt(d,3))}}copy(t){return super.copy(t),this.parameters=Object.assign({},t.parameters),this}},dn=class{constructor(){this.type="Curve",this.arcLengthDivisions=200,this.needsUpdate=!1,this.cacheArcLengths=null}getPoint(){Nt("Curve: .getPoint() not implemented.")}getPointAt(t,e){let i=this.getUtoTmapping(t);return this.getPoint(i,e)}getPoints(t=5){let e=[];for(let i=0;i<=t;i++)e.push(this.getPoint(i/t));return e}getSpacedPoints(t=5){let e=[];for(let i=0;i<=t;i++)e.push(this.getPointAt(i/t));return e}getLength(){let t=this.getLengths();return t[t.length-1]}getLengths(t=this.arcLengthDivisions){if(this.cacheArcLengths&&this.cacheArcLengths.length===t+1&&!this.needsUpdate)return this.cacheArcLengths;this.needsUpdate=!1;let e=[],i,s=this.getPoint(0),r=0;e.push(0);for(let o=1;o<=t;o++)i=this.getPoint(o/t),r+=i.distanceTo(s),e.push(r),s=i;return this.cacheArcLengths=e,e}updateArcLengths(){this.needsUpdate=!0,this.getLengths()}getUtoTmapping(t,e=null){let i=this.getLengths(),s=0,r=i.length,o;e?o=e:o=t*i[r-1];let a=0,c=r-1,l;for(;a<=c;)if(s=Math.floor(a+(c-a)/2),l=i[s]-o,l<0)a=s+1;else if(l>0)c=s-1;else{c=s;break}if(s=c,i[s]===o)return s/(r-1);let h=i[s],f=i[s+1]-h,d=(o-h)/f;return(s+d)/(r-1)}getTangent(t,e){let s=t-1e-4,r=t+1e-4;s<0&&(s=0),r>1&&(r=1);let o=this.getPoint(s),a=this.getPoint(r),c=e||(o.isVector2?new ht:new P);return c.copy(a).sub(o).normalize(),c}getTangentAt(t,e){let i=this.getUtoTmapping(t);return this.getTangent(i,e)}computeFrenetFrames(t,e=!1){let i=new P,s=[],r=[],o=[],a=new P,c=new re;for(let d=0;d<=t;d++){let m=d/t;s[d]=this.getTangentAt(m,new P)}r[0]=new P,o[0]=new P;let l=Number.MAX_VALUE,h=Math.abs(s[0].x),u=Math.abs(s[0].y),f=Math.abs(s[0].z);h<=l&&(l=h,i.set(1,0,0)),u<=l&&(l=u,i.set(0,1,0)),f<=l&&i.set(0,0,1),a.crossVectors(s[0],i).normalize(),r[0].crossVectors(s[0],a),o[0].crossVectors(s[0],r[0]);for(let d=1;d<=t;d++){if(r[d]=r[d-1].clone(),o[d]=o[d-1].clone(),a.crossVectors(s[d-1],s[d]),a.length()>Number.EPSILON){a.normalize();let m=Math.acos(Ft(s[d-1].dot(s[d]),-1,1));r[d].applyMatrix4(c.makeRotationAxis(a,m))}o[d].crossVectors(s[d],r[d])}if(e===!0){let d=Math.acos(Ft(r[0].dot(r[t]),-1,1));d/=t,s[0].dot(a.crossVectors(r[0],r[t]))>0&&(d=-d);for(let m=1;m<=t;m++)r[m].applyMatrix4(c.makeRotationAxis(s[m],d*m)),o[m].crossVectors(s[m],r[m])}return{tangents:s,normals:r,binormals:o}}clone(){return new this.constructor().copy(this)}copy(t){return this.arcLengthDivisions=t.arcLengthDivisions,this.cacheArcLengths=null,this}toJSON(){let t={metadata:{version:4.7,type:"Curve",generator:"Curve.toJSON"}};return t.arcLengthDivisions=this.arcLengthDivisions,t.type=this.type,t}fromJSON(t){return this.arcLengthDivisions=t.arcLengthDivisions,this.cacheArcLengths=null,this}},Rr=class extends dn{constructor(t=0,e=0,i=1,s=1,r=0,o=Math.PI*2,a=!1,c=0){super(),this.isEllipseCurve=!0,this.type="EllipseCurve",this.aX=t,this.aY=e,this.xRadius=i,this.yRadius=s,this.aStartAngle=r,this.aEndAngle=o,this.aClockwise=a,this.aRotation=c}getPoint(t,e=new ht){let i=e,s=Math.PI*2,r=this.aEndAngle-this.aStartAngle,o=Math.abs(r)<Number.EPSILON;for(;r<0;)r+=s;for(;r>s;)r-=s;r<Number.EPSILON&&(o?r=0:r=s),this.aClockwise===!0&&!o&&(r===s?r=-s:r=r-s);let a=this.aStartAngle+t*r,c=this.aX+this.xRadius*Math.cos(a),l=this.aY+this.yRadius*Math.sin(a);if(this.aRotation!==0){let h=Math.cos(this.aRotation),u=Math.sin(this.aRotation),f=c-this.aX,d=l-this.aY;c=f*h-d*u+this.aX,l=f*u+d*h+this.aY}return i.set(c,l)}copy(t){return super.copy(t),this.aX=t.aX,this.aY=t.aY,this.xRadius=t.xRadius,this.yRadius=t.yRadius,this.aStartAngle=t.aStartAngle,this.aEndAngle=t.aEndAngle,this.aClockwise=t.aClockwise,this.aRotation=t.aRotation,this}toJSON(){let t=super.toJSON();return t.aX=this.aX,t.aY=this.aY,t.xRadius=this.xRadius,t.yRadius=this.yRadius,t.aStartAngle=this.aStartAngle,t.aEndAngle=this.aEndAngle,t.aClockwise=this.aClockwise,t.aRotation=this.aRotation,t}fromJSON(t){return super.fromJSON(t),this.aX=t.aX,this.aY=t.aY,this.xRadius=t.xRadius,this.yRadius=t.yRadius,this.aStartAngle=t.aStartAngle,this.aEndAngle=t.aEndAngle,this.aClockwise=t.aClockwise,this.aRotation=t.aRotation,this}},Yl=class extends Rr{constructor(t,e,i,s,r,o){super(t,e,i,i,s,r,o),this.isArcCurve=!0,this.type="ArcCurve"}};function Qf(){let n=0,t=0,e=0,i=0;function s(r,o,a,c){n=r,t=a,e=-3*r+3*o-2*a-c,i=2*r-2*o+a+c}return{initCatmullRom:function(r,o,a,c,l){s(o,a,l*(a-r),l*(c-o))},initNonuniformCatmullRom:function(r,o,a,c,l,h,u){let f=(o-r)/l-(a-r)/(l+h)+(a-o)/h,d=(a-o)/h-(c-o)/(h+u)+(c-a)/u;f*=h,d*=h,s(o,a,f,d)},calc:function(r){let o=r*r,a=o*r;return n+t*r+e*o+i*a}}}var Dg=new P,Ug=new P,of=new Qf,af=new Qf,lf=new Qf,Zl=class extends dn{constructor(t=[],e=!1,i="centripetal",s=.5){super(),this.isCatmullRomCurve3=!0,this.type="CatmullRomCurve3",this.points=t,this.closed=e,this.curveType=i,this.tension=s}getPoint(t,e=new P){let i=e,s=this.points,r=s.length,o=(r-(this.closed?0:1))*t,a=Math.floor(o),c=o-a;this.closed?a+=a>0?0:(Math.floor(Math.abs(a)/r)+1)*r:c===0&&a===r-1&&(a=r-2,c=1);let l,h;this.closed||a>0?l=s[(a-1)%r]:(Ug.subVectors(s[0],s[1]).add(s[0]),l=Ug);let u=s[a%r],f=s[(a+1)%r];if(this.closed||a+2<r?h=s[(a+2)%r]:(Dg.subVectors(s[r-1],s[r-2]).add(s[r-1]),h=Dg),this.curveType==="centripetal"||this.curveType==="chordal"){let d=this.curveType==="chordal"?.5:.25,m=Math.pow(l.distanceToSquared(u),d),_=Math.pow(u.distanceToSquared(f),d),p=Math.pow(f.distanceToSquared(h),d);_<1e-4&&(_=1),m<1e-4&&(m=_),p<1e-4&&(p=_),of.initNonuniformCatmullRom(l.x,u.x,f.x,h.x,m,_,p),af.initNonuniformCatmullRom(l.y,u.y,f.y,h.y,m,_,p),lf.initNonuniformCatmullRom(l.z,u.z,f.z,h.z,m,_,p)}else this.curveType==="catmullrom"&&(of.initCatmullRom(l.x,u.x,f.x,h.x,this.tension),af.initCatmullRom(l.y,u.y,f.y,h.y,this.tension),lf.initCatmullRom(l.z,u.z,f.z,h.z,this.tension));return i.set(of.calc(c),af.calc(c),lf.calc(c)),i}copy(t){super.copy(t),this.points=[];for(let e=0,i=t.points.length;e<i;e++){let s=t.points[e];this.points.push(s.clone())}return this.closed=t.closed,this.curveType=t.curveType,this.tension=t.tension,this}toJSON(){let t=super.toJSON();t.points=[];for(let e=0,i=this.points.length;e<i;e++){let s=this.points[e];t.points.push(s.toArray())}return t.closed=this.closed,t.curveType=this.curveType,t.tension=this.tension,t}fromJSON(t){super.fromJSON(t),this.points=[];for(let e=0,i=t.points.length;e<i;e++){let s=t.points[e];this.points.push(new P().fromArray(s))}return this.closed=t.closed,this.curveType=t.curveType,this.tension=t.tension,this}};function Og(n,t,e,i,s){let r=(i-t)*.5,o=(s-e)*.5,a=n*n,c=n*a;return(2*e-2*i+r+o)*c+(-3*e+3*i-2*r-o)*a+r*n+e}function db(n,t){let e=1-n;return e*e*t}function pb(n,t){return 2*(1-n)*n*t}function mb(n,t){return n*n*t}function go(n,t,e,i){return db(n,t)+pb(n,e)+mb(n,i)}function gb(n,t){let e=1-n;return e*e*e*t}function _b(n,t){let e=1-n;return 3*e*e*n*t}function xb(n,t){return 3*(1-n)*n*n*t}function yb(n,t){return n*n*n*t}function _o(n,t,e,i,s){return gb(n,t)+_b(n,e)+xb(n,i)+yb(n,s)}var No=class extends dn{constructor(t=new ht,e=new ht,i=new ht,s=new ht){super(),this.isCubicBezierCurve=!0,this.type="CubicBezierCurve",this.v0=t,this.v1=e,this.v2=i,this.v3=s}getPoint(t,e=new ht){let i=e,s=this.v0,r=this.v1,o=this.v2,a=this.v3;return i.set(_o(t,s.x,r.x,o.x,a.x),_o(t,s.y,r.y,o.y,a.y)),i}copy(t){return super.copy(t),this.v0.copy(t.v0),this.v1.copy(t.v1),this.v2.copy(t.v2),this.v3.copy(t.v3),this}toJSON(){let t=super.toJSON();return t.v0=this.v0.toArray(),t.v1=this.v1.toArray(),t.v2=this.v2.toArray(),t.v3=this.v3.toArray(),t}fromJSON(t){return super.fromJSON(t),this.v0.fromArray(t.v0),this.v1.fromArray(t.v1),this.v2.fromArray(t.v2),this.v3.fromArray(t.v3),this}},Jl=class extends dn{constructor(t=new P,e=new P,i=new P,s=new P){super(),this.isCubicBezierCurve3=!0,this.type="CubicBezierCurve3",this.v0=t,this.v1=e,this.v2=i,this.v3=s}getPoint(t,e=new P){let i=e,s=this.v0,r=this.v1,o=this.v2,a=this.v3;return i.set(_o(t,s.x,r.x,o.x,a.x),_o(t,s.y,r.y,o.y,a.y),_o(t,s.z,r.z,o.z,a.z)),i}copy(t){return super.copy(t),this.v0.copy(t.v0),this.v1.copy(t.v1),this.v2.copy(t.v2),this.v3.copy(t.v3),this}toJSON(){let t=super.toJSON();return t.v0=this.v0.toArray(),t.v1=this.v1.toArray(),t.v2=this.v2.toArray(),t.v3=this.v3.toArray(),t}fromJSON(t){return super.fromJSON(t),this.v0.fromArray(t.v0),this.v1.fromArray(t.v1),this.v2.fromArray(t.v2),this.v3.fromArray(t.v3),this}},Do=class extends dn{constructor(t=new ht,e=new ht){super(),this.isLineCurve=!0,this.type="LineCurve",this.v1=t,this.v2=e}getPoint(t,e=new ht){let i=e;return t===1?i.copy(this.v2):(i.copy(this.v2).sub(this.v1),i.multiplyScalar(t).add(this.v1)),i}getPointAt(t,e){return this.getPoint(t,e)}getTangent(t,e=new ht){return e.subVectors(this.v2,this.v1).normalize()}getTangentAt(t,e){return this.getTangent(t,e)}copy(t){return super.copy(t),this.v1.copy(t.v1),this.v2.copy(t.v2),this}toJSON(){let t=super.toJSON();return t.v1=this.v1.toArray(),t.v2=this.v2.toArray(),t}fromJSON(t){return super.fromJSON(t),this.v1.fromArray(t.v1),this.v2.fromArray(t.v2),this}},jl=class extends dn{constructor(t=new P,e=new P){super(),this.isLineCurve3=!0,this.type="LineCurve3",this.v1=t,this.v2=e}getPoint(t,e=new P){let i=e;return t===1?i.copy(this.v2):(i.copy(this.v2).sub(this.v1),i.multiplyScalar(t).add(this.v1)),i}getPointAt(t,e){return this.getPoint(t,e)}getTangent(t,e=new P){return e.subVectors(this.v2,this.v1).normalize()}getTangentAt(t,e){return this.getTangent(t,e)}copy(t){return super.copy(t),this.v1.copy(t.v1),this.v2.copy(t.v2),this}toJSON(){let t=super.toJSON();return t.v1=this.v1.toArray(),t.v2=this.v2.toArray(),t}fromJSON(t){return super.fromJSON(t),this.v1.fromArray(t.v1),this.v2.fromArray(t.v2),this}},Uo=class extends dn{constructor(t=new ht,e=new ht,i=new ht){super(),this.isQuadraticBezierCurve=!0,this.type="QuadraticBezierCurve",this.v0=t,this.v1=e,this.v2=i}getPoint(t,e=new ht){let i=e,s=this.v0,r=this.v1,o=this.v2;return i.set(go(t,s.x,r.x,o.x),go(t,s.y,r.y,o.y)),i}copy(t){return super.copy(t),this.v0.copy(t.v0),this.v1.copy(t.v1),this.v2.copy(t.v2),this}toJSON(){let t=super.toJSON();return t.v0=this.v0.toArray(),t.v1=this.v1.toArray(),t.v2=this.v2.toArray(),t}fromJSON(t){return super.fromJSON(t),this.v0.fromArray(t.v0),this.v1.fromArray(t.v1),this.v2.fromArray(t.v2),this}},Kl=class extends dn{constructor(t=new P,e=new P,i=new P){super(),this.isQuadraticBezierCurve3=!0,this.type="QuadraticBezierCurve3",this.v0=t,this.v1=e,this.v2=i}getPoint(t,e=new P){let i=e,s=this.v0,r=this.v1,o=this.v2;return i.set(go(t,s.x,r.x,o.x),go(t,s.y,r.y,o.y),go(t,s.z,r.z,o.z)),i}copy(t){return super.copy(t),this.v0.copy(t.v0),this.v1.copy(t.v1),this.v2.copy(t.v2),this}toJSON(){let t=super.toJSON();return t.v0=this.v0.toArray(),t.v1=this.v1.toArray(),t.v2=this.v2.toArray(),t}fromJSON(t){return super.fromJSON(t),this.v0.fromArray(t.v0),this.v1.fromArray(t.v1),this.v2.fromArray(t.v2),this}},Oo=class extends dn{constructor(t=[]){super(),this.isSplineCurve=!0,this.type="SplineCurve",this.points=t}getPoint(t,e=new ht){let i=e,s=this.points,r=(s.length-1)*t,o=Math.floor(r),a=r-o,c=s[o===0?o:o-1],l=s[o],h=s[o>s.length-2?s.length-1:o+1],u=s[o>s.length-3?s.length-1:o+2];return i.set(Og(a,c.x,l.x,h.x,u.x),Og(a,c.y,l.y,h.y,u.y)),i}copy(t){super.copy(t),this.points=[];for(let e=0,i=t.points.length;e<i;e++){let s=t.points[e];this.points.push(s.clone())}return this}toJSON(){let t=super.toJSON();t.points=[];for(let e=0,i=this.points.length;e<i;e++){let s=this.points[e];t.points.push(s.toArray())}return t}fromJSON(t){super.fromJSON(t),this.points=[];for(let e=0,i=t.points.length;e<i;e++){let s=t.points[e];this.points.push(new ht().fromArray(s))}return this}},Fg=Object.freeze({__proto__:null,ArcCurve:Yl,CatmullRomCurve3:Zl,CubicBezierCurve:No,CubicBezierCurve3:Jl,EllipseCurve:Rr,LineCurve:Do,LineCurve3:jl,QuadraticBezierCurve:Uo,QuadraticBezierCurve3:Kl,SplineCurve:Oo}),Ql=class extends dn{constructor(){super(),this.type="CurvePath",this.curves=[],this.autoClose=!1,this.cacheLengths=null}add(t){this.curves.push(t)}closePath(){let t=this.curves[0].getPoint(0),e=this.curves[this.curves.length-1].getPoint(1);if(!t.equals(e)){let i=t.isVector2===!0?"LineCurve":"LineCurve3";this.curves.push(new Fg[i](e,t))}return this}getPoint(t,e){let i=t*this.getLength(),s=this.getCurveLengths(),r=0;for(;r<s.length;){if(s[r]>=i){let o=s[r]-i,a=this.curves[r],c=a.getLength(),l=c===0?0:1-o/c;return a.getPointAt(l,e)}r++}return null}getLength(){let t=this.getCurveLengths();return t[t.length-1]}updateArcLengths(){this.needsUpdate=!0,this.cacheLengths=null,this.getCurveLengths()}getCurveLengths(){if(this.cacheLengths&&this.cacheLengths.length===this.curves.length)return this.cacheLengths;let t=[],e=0;for(let i=0,s=this.curves.length;i<s;i++)e+=this.curves[i].getLength(),t.push(e);return this.cacheLengths=t,t}getSpacedPoints(t=40){let e=[];for(let i=0;i<=t;i++)e.push(this.getPoint(i/t));return this.autoClose&&e.push(e[0]),e}getPoints(t=12){let e=[],i;for(let s=0,r=this.curves;s<r.length;s++){let o=r[s],a=o.isEllipseCurve?t*2:o.isLineCurve||o.isLineCurve3?1:o.isSplineCurve?t*o.points.length:t,c=o.getPoints(a);for(let l=0;l<c.length;l++){let h=c[l];i&&i.equals(h)||(e.push(h),i=h)}}return this.autoClose&&e.length>1&&!e[e.length-1].equals(e[0])&&e.push(e[0]),e}copy(t){super.copy(t),this.curves=[];for(let e=0,i=t.curves.length;e<i;e++){let s=t.curves[e];this.curves.push(s.clone())}return this.autoClose=t.autoClose,this.cacheLengths=null,this}toJSON(){let t=super.toJSON();t.autoClose=this.autoClose,t.curves=[];for(let e=0,i=this.curves.length;e<i;e++){let s=this.curves[e];t.curves.push(s.toJSON())}return t}fromJSON(t){super.fromJSON(t),this.autoClose=t.autoClose,this.curves=[];for(let e=0,i=t.curves.length;e<i;e++){let s=t.curves[e];this.curves.push(new Fg[s.type]().fromJSON(s))}return this.cacheLengths=null,this}},Fo=class extends Ql{constructor(t){super(),this.type="Path",this.currentPoint=new ht,t&&this.setFromPoints(t)}setFromPoints(t){this.moveTo(t[0].x,t[0].y);for(let e=1,i=t.length;e<i;e++)this.lineTo(t[e].x,t[e].y);return this}moveTo(t,e){return this.currentPoint.set(t,e),this}lineTo(t,e){let i=new Do(this.currentPoint.clone(),new ht(t,e));return this.curves.push(i),this.currentPoint.set(t,e),this}quadraticCurveTo(t,e,i,s){let r=new Uo(this.currentPoint.clone(),new ht(t,e),new ht(i,s));return this.curves.push(r),this.currentPoint.set(i,s),this}bezierCurveTo(t,e,i,s,r,o){let a=new No(this.currentPoint.clone(),new ht(t,e),new ht(i,s),new ht(r,o));return this.curves.push(a),this.currentPoint.set(r,o),this}splineThru(t){let e=[this.currentPoint.clone()].concat(t),i=new Oo(e);return this.curves.push(i),this.currentPoint.copy(t[t.length-1]),this}arc(t,e,i,s,r,o){let a=this.currentPoint.x,c=this.currentPoint.y;return this.absarc(t+a,e+c,i,s,r,o),this}absarc(t,e,i,s,r,o){return this.absellipse(t,e,i,i,s,r,o),this}ellipse(t,e,i,s,r,o,a,c){let l=this.currentPoint.x,h=this.currentPoint.y;return this.absellipse(t+l,e+h,i,s,r,o,a,c),this}absellipse(t,e,i,s,r,o,a,c){let l=new Rr(t,e,i,s,r,o,a,c);if(this.curves.length>0){let u=l.getPoint(0);u.equals(this.currentPoint)||this.lineTo(u.x,u.y)}this.curves.push(l);let h=l.getPoint(1);return this.currentPoint.copy(h),this}copy(t){return super.copy(t),this.currentPoint.copy(t.currentPoint),this}toJSON(){let t=super.toJSON();return t.currentPoint=this.currentPoint.toArray(),t}fromJSON(t){return super.fromJSON(t),this.currentPoint.fromArray(t.currentPoint),this}},As=class extends Fo{constructor(t){super(t),this.uuid=wi(),this.type="Shape",this.holes=[]}getPointsHoles(t){let e=[];for(let i=0,s=this.holes.length;i<s;i++)e[i]=this.holes[i].getPoints(t);return e}extractPoints(t){return{shape:this.getPoints(t),holes:this.getPointsHoles(t)}}copy(t){super.copy(t),this.holes=[];for(let e=0,i=t.holes.length;e<i;e++){let s=t.holes[e];this.holes.push(s.clone())}return this}toJSON(){let t=super.toJSON();t.uuid=this.uuid,t.holes=[];for(let e=0,i=this.holes.length;e<i;e++){let s=this.holes[e];t.holes.push(s.toJSON())}return t}fromJSON(t){super.fromJSON(t),this.uuid=t.uuid,this.holes=[];for(let e=0,i=t.holes.length;e<i;e++){let s=t.holes[e];this.holes.push(new Fo().fromJSON(s))}return this}};function vb(n,t,e=2){let i=t&&t.length,s=i?t[0]*e:n.length,r=U0(n,0,s,e,!0),o=[];if(!r||r.next===r.prev)return o;let a,c,l;if(i&&(r=Ab(n,t,r,e)),n.length>80*e){a=n[0],c=n[1];let h=a,u=c;for(let f=e;f<s;f+=e){let d=n[f],m=n[f+1];d<a&&(a=d),m<c&&(c=m),d>h&&(h=d),m>u&&(u=m)}l=Math.max(h-a,u-c),l=l!==0?32767/l:0}return Bo(r,o,e,a,c,l,0),o}function U0(n,t,e,i,s){let r;if(s===Ob(n,t,e,i)>0)for(let o=t;o<e;o+=i)r=Bg(o/i|0,n[o],n[o+1],r);else for(let o=e-i;o>=t;o-=i)r=Bg(o/i|0,n[o],n[o+1],r);return r&&Pr(r,r.next)&&(zo(r),r=r.next),r}function Es(n,t){if(!n)return n;t||(t=n);let e=n,i;do if(i=!1,!e.steiner&&(Pr(e,e.next)||_e(e.prev,e,e.next)===0)){if(zo(e),e=t=e.prev,e===e.next)break;i=!0}else e=e.next;while(i||e!==t);return t}function Bo(n,t,e,i,s,r,o){if(!n)return;!o&&r&&Pb(n,i,s,r);let a=n;for(;n.prev!==n.next;){let c=n.prev,l=n.next;if(r?Mb(n,i,s,r):bb(n)){t.push(c.i,n.i,l.i),zo(n),n=l.next,a=l.next;continue}if(n=l,n===a){o?o===1?(n=Sb(Es(n),t),Bo(n,t,e,i,s,r,2)):o===2&&wb(n,t,e,i,s,r):Bo(Es(n),t,e,i,s,r,1);break}}}function bb(n){let t=n.prev,e=n,i=n.next;if(_e(t,e,i)>=0)return!1;let s=t.x,r=e.x,o=i.x,a=t.y,c=e.y,l=i.y,h=Math.min(s,r,o),u=Math.min(a,c,l),f=Math.max(s,r,o),d=Math.max(a,c,l),m=i.next;for(;m!==t;){if(m.x>=h&&m.x<=f&&m.y>=u&&m.y<=d&&fo(s,a,r,c,o,l,m.x,m.y)&&_e(m.prev,m,m.next)>=0)return!1;m=m.next}return!0}function Mb(n,t,e,i){let s=n.prev,r=n,o=n.next;if(_e(s,r,o)>=0)return!1;let a=s.x,c=r.x,l=o.x,h=s.y,u=r.y,f=o.y,d=Math.min(a,c,l),m=Math.min(h,u,f),_=Math.max(a,c,l),p=Math.max(h,u,f),g=gf(d,m,t,e,i),x=gf(_,p,t,e,i),b=n.prevZ,v=n.nextZ;for(;b&&b.z>=g&&v&&v.z<=x;){if(b.x>=d&&b.x<=_&&b.y>=m&&b.y<=p&&b!==s&&b!==o&&fo(a,h,c,u,l,f,b.x,b.y)&&_e(b.prev,b,b.next)>=0||(b=b.prevZ,v.x>=d&&v.x<=_&&v.y>=m&&v.y<=p&&v!==s&&v!==o&&fo(a,h,c,u,l,f,v.x,v.y)&&_e(v.prev,v,v.next)>=0))return!1;v=v.nextZ}for(;b&&b.z>=g;){if(b.x>=d&&b.x<=_&&b.y>=m&&b.y<=p&&b!==s&&b!==o&&fo(a,h,c,u,l,f,b.x,b.y)&&_e(b.prev,b,b.next)>=0)return!1;b=b.prevZ}for(;v&&v.z<=x;){if(v.x>=d&&v.x<=_&&v.y>=m&&v.y<=p&&v!==s&&v!==o&&fo(a,h,c,u,l,f,v.x,v.y)&&_e(v.prev,v,v.next)>=0)return!1;v=v.nextZ}return!0}function Sb(n,t){let e=n;do{let i=e.prev,s=e.next.next;!Pr(i,s)&&F0(i,e,e.next,s)&&ko(i,s)&&ko(s,i)&&(t.push(i.i,e.i,s.i),zo(e),zo(e.next),e=n=s),e=e.next}while(e!==n);return Es(e)}function wb(n,t,e,i,s,r){let o=n;do{let a=o.next.next;for(;a!==o.prev;){if(o.i!==a.i&&Nb(o,a)){let c=B0(o,a);o=Es(o,o.next),c=Es(c,c.next),Bo(o,t,e,i,s,r,0),Bo(c,t,e,i,s,r,0);return}a=a.next}o=o.next}while(o!==n)}function Ab(n,t,e,i){let s=[];for(let r=0,o=t.length;r<o;r++){let a=t[r]*i,c=r<o-1?t[r+1]*i:n.length,l=U0(n,a,c,i,!1);l===l.next&&(l.steiner=!0),s.push(Lb(l))}s.sort(Eb);for(let r=0;r<s.length;r++)e=Tb(s[r],e);return e}function Eb(n,t){let e=n.x-t.x;if(e===0&&(e=n.y-t.y,e===0)){let i=(n.next.y-n.y)/(n.next.x-n.x),s=(t.next.y-t.y)/(t.next.x-t.x);e=i-s}return e}function Tb(n,t){let e=Cb(n,t);if(!e)return t;let i=B0(e,n);return Es(i,i.next),Es(e,e.next)}function Cb(n,t){let e=t,i=n.x,s=n.y,r=-1/0,o;if(Pr(n,e))return e;do{if(Pr(n,e.next))return e.next;if(s<=e.y&&s>=e.next.y&&e.next.y!==e.y){let u=e.x+(s-e.y)*(e.next.x-e.x)/(e.next.y-e.y);if(u<=i&&u>r&&(r=u,o=e.x<e.next.x?e:e.next,u===i))return o}e=e.next}while(e!==t);if(!o)return null;let a=o,c=o.x,l=o.y,h=1/0;e=o;do{if(i>=e.x&&e.x>=c&&i!==e.x&&O0(s<l?i:r,s,c,l,s<l?r:i,s,e.x,e.y)){let u=Math.abs(s-e.y)/(i-e.x);ko(e,n)&&(u<h||u===h&&(e.x>o.x||e.x===o.x&&Rb(o,e)))&&(o=e,h=u)}e=e.next}while(e!==a);return o}function Rb(n,t){return _e(n.prev,n,t.prev)<0&&_e(t.next,n,n.next)<0}function Pb(n,t,e,i){let s=n;do s.z===0&&(s.z=gf(s.x,s.y,t,e,i)),s.prevZ=s.prev,s.nextZ=s.next,s=s.next;while(s!==n);s.prevZ.nextZ=null,s.prevZ=null,Ib(s)}function Ib(n){let t,e=1;do{let i=n,s;n=null;let r=null;for(t=0;i;){t++;let o=i,a=0;for(let l=0;l<e&&(a++,o=o.nextZ,!!o);l++);let c=e;for(;a>0||c>0&&o;)a!==0&&(c===0||!o||i.z<=o.z)?(s=i,i=i.nextZ,a--):(s=o,o=o.nextZ,c--),r?r.nextZ=s:n=s,s.prevZ=r,r=s;i=o}r.nextZ=null,e*=2}while(t>1);return n}function gf(n,t,e,i,s){return n=(n-e)*s|0,t=(t-i)*s|0,n=(n|n<<8)&16711935,n=(n|n<<4)&252645135,n=(n|n<<2)&858993459,n=(n|n<<1)&1431655765,t=(t|t<<8)&16711935,t=(t|t<<4)&252645135,t=(t|t<<2)&858993459,t=(t|t<<1)&1431655765,n|t<<1}function Lb(n){let t=n,e=n;do(t.x<e.x||t.x===e.x&&t.y<e.y)&&(e=t),t=t.next;while(t!==n);return e}function O0(n,t,e,i,s,r,o,a){return(s-o)*(t-a)>=(n-o)*(r-a)&&(n-o)*(i-a)>=(e-o)*(t-a)&&(e-o)*(r-a)>=(s-o)*(i-a)}function fo(n,t,e,i,s,r,o,a){return!(n===o&&t===a)&&O0(n,t,e,i,s,r,o,a)}function Nb(n,t){return n.next.i!==t.i&&n.prev.i!==t.i&&!Db(n,t)&&(ko(n,t)&&ko(t,n)&&Ub(n,t)&&(_e(n.prev,n,t.prev)||_e(n,t.prev,t))||Pr(n,t)&&_e(n.prev,n,n.next)>0&&_e(t.prev,t,t.next)>0)}function _e(n,t,e){return(t.y-n.y)*(e.x-t.x)-(t.x-n.x)*(e.y-t.y)}function Pr(n,t){return n.x===t.x&&n.y===t.y}function F0(n,t,e,i){let s=Ml(_e(n,t,e)),r=Ml(_e(n,t,i)),o=Ml(_e(e,i,n)),a=Ml(_e(e,i,t));return!!(s!==r&&o!==a||s===0&&bl(n,e,t)||r===0&&bl(n,i,t)||o===0&&bl(e,n,i)||a===0&&bl(e,t,i))}function bl(n,t,e){return t.x<=Math.max(n.x,e.x)&&t.x>=Math.min(n.x,e.x)&&t.y<=Math.max(n.y,e.y)&&t.y>=Math.min(n.y,e.y)}function Ml(n){return n>0?1:n<0?-1:0}function Db(n,t){let e=n;do{if(e.i!==n.i&&e.next.i!==n.i&&e.i!==t.i&&e.next.i!==t.i&&F0(e,e.next,n,t))return!0;e=e.next}while(e!==n);return!1}function ko(n,t){return _e(n.prev,n,n.next)<0?_e(n,t,n.next)>=0&&_e(n,n.prev,t)>=0:_e(n,t,n.prev)<0||_e(n,n.next,t)<0}function Ub(n,t){let e=n,i=!1,s=(n.x+t.x)/2,r=(n.y+t.y)/2;do e.y>r!=e.next.y>r&&e.next.y!==e.y&&s<(e.next.x-e.x)*(r-e.y)/(e.next.y-e.y)+e.x&&(i=!i),e=e.next;while(e!==n);return i}function B0(n,t){let e=_f(n.i,n.x,n.y),i=_f(t.i,t.x,t.y),s=n.next,r=t.prev;return n.next=t,t.prev=n,e.next=s,s.prev=e,i.next=e,e.prev=i,r.next=i,i.prev=r,i}function Bg(n,t,e,i){let s=_f(n,t,e);return i?(s.next=i.next,s.prev=i,i.next.prev=s,i.next=s):(s.prev=s,s.next=s),s}function zo(n){n.next.prev=n.prev,n.prev.next=n.next,n.prevZ&&(n.prevZ.nextZ=n.nextZ),n.nextZ&&(n.nextZ.prevZ=n.prevZ)}function _f(n,t,e){return{i:n,x:t,y:e,prev:null,next:null,z:0,prevZ:null,nextZ:null,steiner:!1}}function Ob(n,t,e,i){let s=0;for(let r=t,o=e-i;r<e;r+=i)s+=(n[o]-n[r])*(n[r+1]+n[o+1]),o=r;return s}var xf=class{static triangulate(t,e,i=2){return vb(t,e,i)}},xr=class n{static area(t){let e=t.length,i=0;for(let s=e-1,r=0;r<e;s=r++)i+=t[s].x*t[r].y-t[r].x*t[s].y;return i*.5}static isClockWise(t){return n.area(t)<0}static triangulateShape(t,e){let i=[],s=[],r=[];kg(t),zg(i,t);let o=t.length;e.forEach(kg);for(let c=0;c<e.length;c++)s.push(o),o+=e[c].length,zg(i,e[c]);let a=xf.triangulate(i,s);for(let c=0;c<a.length;c+=3)r.push(a.slice(c,c+3));return r}};function kg(n){let t=n.length;t>2&&n[t-1].equals(n[0])&&n.pop()}function zg(n,t){for(let e=0;e<t.length;e++)n.push(t[e].x),n.push(t[e].y)}var Ts=class n extends ae{constructor(t=1,e=1,i=1,s=1){super(),this.type="PlaneGeometry",this.parameters={width:t,height:e,widthSegments:i,heightSegments:s};let r=t/2,o=e/2,a=Math.floor(i),c=Math.floor(s),l=a+1,h=c+1,u=t/a,f=e/c,d=[],m=[],_=[],p=[];for(let g=0;g<h;g++){let x=g*f-o;for(let b=0;b<l;b++){let v=b*u-r;m.push(v,-x,0),_.push(0,0,1),p.push(b/a),p.push(1-g/c)}}for(let g=0;g<c;g++)for(let x=0;x<a;x++){let b=x+l*g,v=x+l*(g+1),w=x+1+l*(g+1),E=x+1+l*g;d.push(b,v,E),d.push(v,w,E)}this.setIndex(d),this.setAttribute("position",new Vt(m,3)),this.setAttribute("normal",new Vt(_,3)),this.setAttribute("uv",new Vt(p,2))}copy(t){return super.copy(t),this.parameters=Object.assign({},t.parameters),this}static fromJSON(t){return new n(t.width,t.height,t.widthSegments,t.heightSegments)}},vi=class n extends ae{constructor(t=.5,e=1,i=32,s=1,r=0,o=Math.PI*2){super(),this.type="RingGeometry",this.parameters={innerRadius:t,outerRadius:e,thetaSegments:i,phiSegments:s,thetaStart:r,thetaLength:o},i=Math.max(3,i),s=Math.max(1,s);let a=[],c=[],l=[],h=[],u=t,f=(e-t)/s,d=new P,m=new ht;for(let _=0;_<=s;_++){for(let p=0;p<=i;p++){let g=r+p/i*o;d.x=u*Math.cos(g),d.y=u*Math.sin(g),c.push(d.x,d.y,d.z),l.push(0,0,1),m.x=(d.x/e+1)/2,m.y=(d.y/e+1)/2,h.push(m.x,m.y)}u+=f}for(let _=0;_<s;_++){let p=_*(i+1);for(let g=0;g<i;g++){let x=g+p,b=x,v=x+i+1,w=x+i+2,E=x+1;a.push(b,v,E),a.push(v,w,E)}}this.setIndex(a),this.setAttribute("position",new Vt(c,3)),this.setAttribute("normal",new Vt(l,3)),this.setAttribute("uv",new Vt(h,2))}copy(t){return super.copy(t),this.parameters=Object.assign({},t.parameters),this}static fromJSON(t){return new n(t.innerRadius,t.outerRadius,t.thetaSegments,t.phiSegments,t.thetaStart,t.thetaLength)}},Ir=class n extends ae{constructor(t=new As([new ht(0,.5),new ht(-.5,-.5),new ht(.5,-.5)]),e=12){super(),this.type="ShapeGeometry",this.parameters={shapes:t,curveSegments:e};let i=[],s=[],r=[],o=[],a=0,c=0;if(Array.isArray(t)===!1)l(t);else for(let h=0;h<t.length;h++)l(t[h]),this.addGroup(a,c,h),a+=c,c=0;this.setIndex(i),this.setAttribute("position",new Vt(s,3)),this.setAttribute("normal",new Vt(r,3)),this.setAttribute("uv",new Vt(o,2));function l(h){let u=s.length/3,f=h.extractPoints(e),d=f.shape,m=f.holes;xr.isClockWise(d)===!1&&(d=d.reverse());for(let p=0,g=m.length;p<g;p++){let x=m[p];xr.isClockWise(x)===!0&&(m[p]=x.reverse())}let _=xr.triangulateShape(d,m);for(let p=0,g=m.length;p<g;p++){let x=m[p];d=d.concat(x)}for(let p=0,g=d.length;p<g;p++){let x=d[p];s.push(x.x,x.y,0),r.push(0,0,1),o.push(x.x,x.y)}for(let p=0,g=_.length;p<g;p++){let x=_[p],b=x[0]+u,v=x[1]+u,w=x[2]+u;i.push(b,v,w),c+=3}}}copy(t){return super.copy(t),this.parameters=Object.assign({},t.parameters),this}toJSON(){let t=super.toJSON(),e=this.parameters.shapes;return Fb(e,t)}static fromJSON(t,e){let i=[];for(let s=0,r=t.shapes.length;s<r;s++){let o=e[t.shapes[s]];i.push(o)}return new n(i,t.curveSegments)}};function Fb(n,t){if(t.shapes=[],Array.isArray(n))for(let e=0,i=n.length;e<i;e++){let s=n[e];t.shapes.push(s.uuid)}else t.shapes.push(n.uuid);return t}var Cs=class n extends ae{constructor(t=1,e=32,i=16,s=0,r=Math.PI*2,o=0,a=Math.PI){super(),this.type="SphereGeometry",this.parameters={radius:t,widthSegments:e,heightSegments:i,phiStart:s,phiLength:r,thetaStart:o,thetaLength:a},e=Math.max(3,Math.floor(e)),i=Math.max(2,Math.floor(i));let c=Math.min(o+a,Math.PI),l=0,h=[],u=new P,f=new P,d=[],m=[],_=[],p=[];for(let g=0;g<=i;g++){let x=[],b=g/i,v=o+b*a,w=t*Math.cos(v),E=Math.sqrt(t*t-w*w),y=0;g===0&&o===0?y=.5/e:g===i&&c===Math.PI&&(y=-.5/e);for(let M=0;M<=e;M++){let L=M/e,R=s+L*r;u.x=-E*Math.cos(R),u.y=w,u.z=E*Math.sin(R),m.push(u.x,u.y,u.z),f.copy(u).normalize(),_.push(f.x,f.y,f.z),p.push(L+y,1-b),x.push(l++)}h.push(x)}for(let g=0;g<i;g++)for(let x=0;x<e;x++){let b=h[g][x+1],v=h[g][x],w=h[g+1][x],E=h[g+1][x+1];(g!==0||o>0)&&d.push(b,v,E),(g!==i-1||c<Math.PI)&&d.push(v,w,E)}this.setIndex(d),this.setAttribute("position",new Vt(m,3)),this.setAttribute("normal",new Vt(_,3)),this.setAttribute("uv",new Vt(p,2))}copy(t){return super.copy(t),this.parameters=Object.assign({},t.parameters),this}static fromJSON(t){return new n(t.radius,t.widthSegments,t.heightSegments,t.phiStart,t.phiLength,t.thetaStart,t.thetaLength)}};var Vo=class extends ae{constructor(t=null){if(super(),this.type="WireframeGeometry",this.parameters={geometry:t},t!==null){let e=[],i=new Set,s=new P,r=new P;if(t.index!==null){let o=t.attributes.position,a=t.index,c=t.groups;c.length===0&&(c=[{start:0,count:a.count,materialIndex:0}]);for(let l=0,h=c.length;l<h;++l){let u=c[l],f=u.start,d=u.count;for(let m=f,_=f+d;m<_;m+=3)for(let p=0;p<3;p++){let g=a.getX(m+p),x=a.getX(m+(p+1)%3);s.fromBufferAttribute(o,g),r.fromBufferAttribute(o,x),Vg(s,r,i)===!0&&(e.push(s.x,s.y,s.z),e.push(r.x,r.y,r.z))}}}else{let o=t.attributes.position;for(let a=0,c=o.count/3;a<c;a++)for(let l=0;l<3;l++){let h=3*a+l,u=3*a+(l+1)%3;s.fromBufferAttribute(o,h),r.fromBufferAttribute(o,u),Vg(s,r,i)===!0&&(e.push(s.x,s.y,s.z),e.push(r.x,r.y,r.z))}}this.setAttribute("position",new Vt(e,3))}}copy(t){return super.copy(t),this.parameters=Object.assign({},t.parameters),this}};function Vg(n,t,e){let i=`${n.x},${n.y},${n.z}-${t.x},${t.y},${t.z}`,s=`${t.x},${t.y},${t.z}-${n.x},${n.y},${n.z}`;return e.has(i)===!0||e.has(s)===!0?!1:(e.add(i),e.add(s),!0)}function Ds(n){let t={};for(let e in n){t[e]={};for(let i in n[e]){let s=n[e][i];if(Gg(s))s.isRenderTargetTexture?(Nt("UniformsUtils: Textures of render targets cannot be cloned via cloneUniforms() or mergeUniforms()."),t[e][i]=null):t[e][i]=s.clone();else if(Array.isArray(s))if(Gg(s[0])){let r=[];for(let o=0,a=s.length;o<a;o++)r[o]=s[o].clone();t[e][i]=r}else t[e][i]=s.slice();else t[e][i]=s}}return t}function $e(n){let t={};for(let e=0;e<n.length;e++){let i=Ds(n[e]);for(let s in i)t[s]=i[s]}return t}function Gg(n){return n&&(n.isColor||n.isMatrix3||n.isMatrix4||n.isVector2||n.isVector3||n.isVector4||n.isTexture||n.isQuaternion)}function Bb(n){let t=[];for(let e=0;e<n.length;e++)t.push(n[e].clone());return t}function td(n){let t=n.getRenderTarget();return t===null?n.outputColorSpace:t.isXRRenderTarget===!0?t.texture.colorSpace:Jt.workingColorSpace}var aa={clone:Ds,merge:$e},kb=`void main() {
	gl_Position = projectionMatrix * modelViewMatrix * vec4( position, 1.0 );
}`,zb=`void main() {
	gl_FragColor = vec4( 1.0, 0.0, 0.0, 1.0 );
}`,En=class extends Yn{constructor(t){super(),this.isShaderMaterial=!0,this.type="ShaderMaterial",this.defines={},this.uniforms={},this.uniformsGroups=[],this.vertexShader=kb,this.fragmentShader=zb,this.linewidth=1,this.wireframe=!1,this.wireframeLinewidth=1,this.fog=!1,this.lights=!1,this.clipping=!1,this.forceSinglePass=!0,this.extensions={clipCullDistance:!1,multiDraw:!1},this.defaultAttributeValues={color:[1,1,1],uv:[0,0],uv1:[0,0]},this.index0AttributeName=void 0,this.uniformsNeedUpdate=!1,this.glslVersion=null,t!==void 0&&this.setValues(t)}copy(t){return super.copy(t),this.fragmentShader=t.fragmentShader,this.vertexShader=t.vertexShader,this.uniforms=Ds(t.uniforms),this.uniformsGroups=Bb(t.uniformsGroups),this.defines=Object.assign({},t.defines),this.wireframe=t.wireframe,this.wireframeLinewidth=t.wireframeLinewidth,this.fog=t.fog,this.lights=t.lights,this.clipping=t.clipping,this.extensions=Object.assign({},t.extensions),this.glslVersion=t.glslVersion,this.defaultAttributeValues=Object.assign({},t.defaultAttributeValues),this.index0AttributeName=t.index0AttributeName,this.uniformsNeedUpdate=t.uniformsNeedUpdate,this}toJSON(t){let e=super.toJSON(t);e.glslVersion=this.glslVersion,e.uniforms={};for(let s in this.uniforms){let o=this.uniforms[s].value;o&&o.isTexture?e.uniforms[s]={type:"t",value:o.toJSON(t).uuid}:o&&o.isColor?e.uniforms[s]={type:"c",value:o.getHex()}:o&&o.isVector2?e.uniforms[s]={type:"v2",value:o.toArray()}:o&&o.isVector3?e.uniforms[s]={type:"v3",value:o.toArray()}:o&&o.isVector4?e.uniforms[s]={type:"v4",value:o.toArray()}:o&&o.isMatrix3?e.uniforms[s]={type:"m3",value:o.toArray()}:o&&o.isMatrix4?e.uniforms[s]={type:"m4",value:o.toArray()}:e.uniforms[s]={value:o}}Object.keys(this.defines).length>0&&(e.defines=this.defines),e.vertexShader=this.vertexShader,e.fragmentShader=this.fragmentShader,e.lights=this.lights,e.clipping=this.clipping;let i={};for(let s in this.extensions)this.extensions[s]===!0&&(i[s]=!0);return Object.keys(i).length>0&&(e.extensions=i),e}fromJSON(t,e){if(super.fromJSON(t,e),t.uniforms!==void 0)for(let i in t.uniforms){let s=t.uniforms[i];switch(this.uniforms[i]={},s.type){case"t":this.uniforms[i].value=e[s.value]||null;break;case"c":this.uniforms[i].value=new Gt().setHex(s.value);break;case"v2":this.uniforms[i].value=new ht().fromArray(s.value);break;case"v3":this.uniforms[i].value=new P().fromArray(s.value);break;case"v4":this.uniforms[i].value=new oe().fromArray(s.value);break;case"m3":this.uniforms[i].value=new Bt().fromArray(s.value);break;case"m4":this.uniforms[i].value=new re().fromArray(s.value);break;default:this.uniforms[i].value=s.value}}if(t.defines!==void 0&&(this.defines=t.defines),t.vertexShader!==void 0&&(this.vertexShader=t.vertexShader),t.fragmentShader!==void 0&&(this.fragmentShader=t.fragmentShader),t.glslVersion!==void 0&&(this.glslVersion=t.glslVersion),t.extensions!==void 0)for(let i in t.extensions)this.extensions[i]=t.extensions[i];return t.lights!==void 0&&(this.lights=t.lights),t.clipping!==void 0&&(this.clipping=t.clipping),this}},tc=class extends En{constructor(t){super(t),this.isRawShaderMaterial=!0,this.type="RawShaderMaterial"}};var Rs=class extends Yn{constructor(t){super(),this.isMeshLambertMaterial=!0,this.type="MeshLambertMaterial",this.color=new Gt(16777215),this.map=null,this.lightMap=null,this.lightMapIntensity=1,this.aoMap=null,this.aoMapIntensity=1,this.emissive=new Gt(0),this.emissiveIntensity=1,this.emissiveMap=null,this.bumpMap=null,this.bumpScale=1,this.normalMap=null,this.normalMapType=eh,this.normalScale=new ht(1,1),this.displacementMap=null,this.displacementScale=1,this.displacementBias=0,this.specularMap=null,this.alphaMap=null,this.envMap=null,this.envMapRotation=new mi,this.combine=mc,this.reflectivity=1,this.envMapIntensity=1,this.refractionRatio=.98,this.wireframe=!1,this.wireframeLinewidth=1,this.wireframeLinecap="round",this.wireframeLinejoin="round",this.flatShading=!1,this.fog=!0,this.setValues(t)}copy(t){return super.copy(t),this.color.copy(t.color),this.map=t.map,this.lightMap=t.lightMap,this.lightMapIntensity=t.lightMapIntensity,this.aoMap=t.aoMap,this.aoMapIntensity=t.aoMapIntensity,this.emissive.copy(t.emissive),this.emissiveMap=t.emissiveMap,this.emissiveIntensity=t.emissiveIntensity,this.bumpMap=t.bumpMap,this.bumpScale=t.bumpScale,this.normalMap=t.normalMap,this.normalMapType=t.normalMapType,this.normalScale.copy(t.normalScale),this.displacementMap=t.displacementMap,this.displacementScale=t.displacementScale,this.displacementBias=t.displacementBias,this.specularMap=t.specularMap,this.alphaMap=t.alphaMap,this.envMap=t.envMap,this.envMapRotation.copy(t.envMapRotation),this.combine=t.combine,this.reflectivity=t.reflectivity,this.envMapIntensity=t.envMapIntensity,this.refractionRatio=t.refractionRatio,this.wireframe=t.wireframe,this.wireframeLinewidth=t.wireframeLinewidth,this.wireframeLinecap=t.wireframeLinecap,this.wireframeLinejoin=t.wireframeLinejoin,this.flatShading=t.flatShading,this.fog=t.fog,this}},ec=class extends Yn{constructor(t){super(),this.isMeshDepthMaterial=!0,this.type="MeshDepthMaterial",this.depthPacking=M0,this.map=null,this.alphaMap=null,this.displacementMap=null,this.displacementScale=1,this.displacementBias=0,this.wireframe=!1,this.wireframeLinewidth=1,this.setValues(t)}copy(t){return super.copy(t),this.depthPacking=t.depthPacking,this.map=t.map,this.alphaMap=t.alphaMap,this.displacementMap=t.displacementMap,this.displacementScale=t.displacementScale,this.displacementBias=t.displacementBias,this.wireframe=t.wireframe,this.wireframeLinewidth=t.wireframeLinewidth,this}},nc=class extends Yn{constructor(t){super(),this.isMeshDistanceMaterial=!0,this.type="MeshDistanceMaterial",this.map=null,this.alphaMap=null,this.displacementMap=null,this.displacementScale=1,this.displacementBias=0,this.setValues(t)}copy(t){return super.copy(t),this.map=t.map,this.alphaMap=t.alphaMap,this.displacementMap=t.displacementMap,this.displacementScale=t.displacementScale,this.displacementBias=t.displacementBias,this}};function ur(n,t){return!n||n.constructor===t?n:typeof t.BYTES_PER_ELEMENT=="number"?new t(n):Array.prototype.slice.call(n)}function Sl(n){return n!==void 0&&n.inTangents!==void 0&&n.outTangents!==void 0}var Hi=class{constructor(t,e,i,s){this.parameterPositions=t,this._cachedIndex=0,this.resultBuffer=s!==void 0?s:new e.constructor(i),this.sampleValues=e,this.valueSize=i,this.settings=null,this.DefaultSettings_={}}evaluate(t){let e=this.parameterPositions,i=this._cachedIndex,s=e[i],r=e[i-1];t:{e:{let o;n:{i:if(!(t<s)){for(let a=i+2;;){if(s===void 0){if(t<r)break i;return i=e.length,this._cachedIndex=i,this.copySampleValue_(i-1)}if(i===a)break;if(r=s,s=e[++i],t<s)break e}o=e.length;break n}if(!(t>=r)){let a=e[1];t<a&&(i=2,r=a);for(let c=i-2;;){if(r===void 0)return this._cachedIndex=0,this.copySampleValue_(0);if(i===c)break;if(s=r,r=e[--i-1],t>=r)break e}o=i,i=0;break n}break t}for(;i<o;){let a=i+o>>>1;t<e[a]?o=a:i=a+1}if(s=e[i],r=e[i-1],r===void 0)return this._cachedIndex=0,this.copySampleValue_(0);if(s===void 0)return i=e.length,this._cachedIndex=i,this.copySampleValue_(i-1)}this._cachedIndex=i,this.intervalChanged_(i,r,s)}return this.interpolate_(i,r,t,s)}getSettings_(){return this.settings||this.DefaultSettings_}copySampleValue_(t){let e=this.resultBuffer,i=this.sampleValues,s=this.valueSize,r=t*s;for(let o=0;o!==s;++o)e[o]=i[r+o];return e}interpolate_(){throw new Error("THREE.Interpolant: Call to abstract method.")}intervalChanged_(){}},ic=class extends Hi{constructor(t,e,i,s){super(t,e,i,s),this._weightPrev=-0,this._offsetPrev=-0,this._weightNext=-0,this._offsetNext=-0,this.DefaultSettings_={endingStart:ff,endingEnd:ff}}intervalChanged_(t,e,i){let s=this.parameterPositions,r=t-2,o=t+1,a=s[r],c=s[o];if(a===void 0)switch(this.getSettings_().endingStart){case df:r=t,a=2*e-i;break;case pf:r=s.length-2,a=e+s[r]-s[r+1];break;default:r=t,a=i}if(c===void 0)switch(this.getSettings_().endingEnd){case df:o=t,c=2*i-e;break;case pf:o=1,c=i+s[1]-s[0];break;default:o=t-1,c=e}let l=(i-e)*.5,h=this.valueSize;this._weightPrev=l/(e-a),this._weightNext=l/(c-i),this._offsetPrev=r*h,this._offsetNext=o*h}interpolate_(t,e,i,s){let r=this.resultBuffer,o=this.sampleValues,a=this.valueSize,c=t*a,l=c-a,h=this._offsetPrev,u=this._offsetNext,f=this._weightPrev,d=this._weightNext,m=(i-e)/(s-e),_=m*m,p=_*m,g=-f*p+2*f*_-f*m,x=(1+f)*p+(-1.5-2*f)*_+(-.5+f)*m+1,b=(-1-d)*p+(1.5+d)*_+.5*m,v=d*p-d*_;for(let w=0;w!==a;++w)r[w]=g*o[h+w]+x*o[l+w]+b*o[c+w]+v*o[u+w];return r}},sc=class extends Hi{constructor(t,e,i,s){super(t,e,i,s)}interpolate_(t,e,i,s){let r=this.resultBuffer,o=this.sampleValues,a=this.valueSize,c=t*a,l=c-a,h=(i-e)/(s-e),u=1-h;for(let f=0;f!==a;++f)r[f]=o[l+f]*u+o[c+f]*h;return r}},rc=class extends Hi{constructor(t,e,i,s){super(t,e,i,s)}interpolate_(t){return this.copySampleValue_(t-1)}},oc=class extends Hi{interpolate_(t,e,i,s){let r=this.resultBuffer,o=this.sampleValues,a=this.valueSize,c=t*a,l=c-a,h=this.inTangents,u=this.outTangents;if(!h||!u){let m=(i-e)/(s-e),_=1-m;for(let p=0;p!==a;++p)r[p]=o[l+p]*_+o[c+p]*m;return r}let f=a*2,d=t-1;for(let m=0;m!==a;++m){let _=o[l+m],p=o[c+m],g=d*f+m*2,x=u[g],b=u[g+1],v=t*f+m*2,w=h[v],E=h[v+1],y=Gb(i,e,x,w,s);r[m]=k0(y,_,b,E,p)}return r}};function k0(n,t,e,i,s){let r=1-n;return r*r*r*t+3*r*r*n*e+3*r*n*n*i+n*n*n*s}function Vb(n,t,e,i,s){let r=1-n;return 3*r*r*(e-t)+6*r*n*(i-e)+3*n*n*(s-i)}function Gb(n,t,e,i,s){let r=(n-t)/(s-t);for(let o=0;o<8;o++){let a=k0(r,t,e,i,s)-n;if(Math.abs(a)<1e-10)break;let c=Vb(r,t,e,i,s);if(Math.abs(c)<1e-10)break;r=Math.max(0,Math.min(1,r-a/c))}return r}var pn=class{constructor(t,e,i,s){if(t===void 0)throw new Error("THREE.KeyframeTrack: track name is undefined");if(e===void 0||e.length===0)throw new Error("THREE.KeyframeTrack: no keyframes in track named "+t);this.name=t,this.times=ur(e,this.TimeBufferType),this.values=ur(i,this.ValueBufferType),this.setInterpolation(s||this.DefaultInterpolation)}static toJSON(t){let e=t.constructor,i;if(e.toJSON!==this.toJSON)i=e.toJSON(t);else{i={name:t.name,times:ur(t.times,Array),values:ur(t.values,Array)};let s=t.getInterpolation();s!==t.DefaultInterpolation&&(i.interpolation=s),Sl(t.settings)&&(i.settings={inTangents:ur(t.settings.inTangents,Array),outTangents:ur(t.settings.outTangents,Array)})}return i.type=t.ValueTypeName,i}InterpolantFactoryMethodDiscrete(t){return new rc(this.times,this.values,this.getValueSize(),t)}InterpolantFactoryMethodLinear(t){return new sc(this.times,this.values,this.getValueSize(),t)}InterpolantFactoryMethodSmooth(t){return new ic(this.times,this.values,this.getValueSize(),t)}InterpolantFactoryMethodBezier(t){let e=new oc(this.times,this.values,this.getValueSize(),t);return this.settings&&(e.inTangents=this.settings.inTangents,e.outTangents=this.settings.outTangents),e}setInterpolation(t){let e;switch(t){case xo:e=this.InterpolantFactoryMethodDiscrete;break;case Bl:e=this.InterpolantFactoryMethodLinear;break;case Tl:e=this.InterpolantFactoryMethodSmooth;break;case uf:e=this.InterpolantFactoryMethodBezier;break}if(e===void 0){let i="unsupported interpolation for "+this.ValueTypeName+" keyframe track named "+this.name;if(this.createInterpolant===void 0)if(t!==this.DefaultInterpolation)this.setInterpolation(this.DefaultInterpolation);else throw new Error(i);return Nt("KeyframeTrack:",i),this}return this.createInterpolant=e,this}getInterpolation(){switch(this.createInterpolant){case this.InterpolantFactoryMethodDiscrete:return xo;case this.InterpolantFactoryMethodLinear:return Bl;case this.InterpolantFactoryMethodSmooth:return Tl;case this.InterpolantFactoryMethodBezier:return uf}}getValueSize(){return this.values.length/this.times.length}shift(t){if(t!==0){let e=this.times;for(let i=0,s=e.length;i!==s;++i)e[i]+=t;Sl(this.settings)&&(Hg(this.settings.inTangents,t),Hg(this.settings.outTangents,t))}return this}scale(t){if(t!==1){let e=this.times;for(let i=0,s=e.length;i!==s;++i)e[i]*=t;Sl(this.settings)&&(Wg(this.settings.inTangents,t),Wg(this.settings.outTangents,t))}return this}trim(t,e){let i=this.times,s=i.length,r=0,o=s-1;for(;r!==s&&i[r]<t;)++r;for(;o!==-1&&i[o]>e;)--o;if(++o,r!==0||o!==s){r>=o&&(o=Math.max(o,1),r=o-1);let a=this.getValueSize();this.times=i.slice(r,o),this.values=this.values.slice(r*a,o*a)}return this}validate(){let t=!0,e=this.getValueSize();e-Math.floor(e)!==0&&(Ot("KeyframeTrack: Invalid value size in track.",this),t=!1);let i=this.times,s=this.values,r=i.length;r===0&&(Ot("KeyframeTrack: Track is empty.",this),t=!1);let o=null;for(let a=0;a!==r;a++){let c=i[a];if(typeof c=="number"&&isNaN(c)){Ot("KeyframeTrack: Time is not a valid number.",this,a,c),t=!1;break}if(o!==null&&o>c){Ot("KeyframeTrack: Out of order keys.",this,a,c,o),t=!1;break}o=c}if(s!==void 0&&Nv(s))for(let a=0,c=s.length;a!==c;++a){let l=s[a];if(isNaN(l)){Ot("KeyframeTrack: Value is not a valid number.",this,a,l),t=!1;break}}return t}optimize(){let t=this.times.slice(),e=this.values.slice(),i=this.getValueSize(),s=this.getInterpolation()===Tl,r=t.length-1,o=1;for(let a=1;a<r;++a){let c=!1,l=t[a],h=t[a+1];if(l!==h&&(a!==1||l!==t[0]))if(s)c=!0;else{let u=a*i,f=u-i,d=u+i;for(let m=0;m!==i;++m){let _=e[u+m];if(_!==e[f+m]||_!==e[d+m]){c=!0;break}}}if(c){if(a!==o){t[o]=t[a];let u=a*i,f=o*i;for(let d=0;d!==i;++d)e[f+d]=e[u+d]}++o}}if(r>0){t[o]=t[r];for(let a=r*i,c=o*i,l=0;l!==i;++l)e[c+l]=e[a+l];++o}return o!==t.length?(this.times=t.slice(0,o),this.values=e.slice(0,o*i)):(this.times=t,this.values=e),this}clone(){let t=this.times.slice(),e=this.values.slice(),i=this.constructor,s=new i(this.name,t,e);return s.createInterpolant=this.createInterpolant,Sl(this.settings)&&(s.settings={inTangents:this.settings.inTangents.slice(),outTangents:this.settings.outTangents.slice()}),s}};function Hg(n,t){for(let e=0,i=n.length;e!==i;e+=2)n[e]+=t}function Wg(n,t){for(let e=0,i=n.length;e!==i;e+=2)n[e]*=t}pn.prototype.ValueTypeName="";pn.prototype.TimeBufferType=Float32Array;pn.prototype.ValueBufferType=Float32Array;pn.prototype.DefaultInterpolation=Bl;var Wi=class extends pn{constructor(t,e,i){super(t,e,i)}};Wi.prototype.ValueTypeName="bool";Wi.prototype.ValueBufferType=Array;Wi.prototype.DefaultInterpolation=xo;Wi.prototype.InterpolantFactoryMethodLinear=void 0;Wi.prototype.InterpolantFactoryMethodSmooth=void 0;var ac=class extends pn{constructor(t,e,i,s){super(t,e,i,s)}};ac.prototype.ValueTypeName="color";var lc=class extends pn{constructor(t,e,i,s){super(t,e,i,s)}};lc.prototype.ValueTypeName="number";var cc=class extends Hi{constructor(t,e,i,s){super(t,e,i,s)}interpolate_(t,e,i,s){let r=this.resultBuffer,o=this.sampleValues,a=this.valueSize,c=(i-e)/(s-e),l=t*a;for(let h=l+a;l!==h;l+=4)Ne.slerpFlat(r,0,o,l-a,o,l,c);return r}},Go=class extends pn{constructor(t,e,i,s){super(t,e,i,s)}InterpolantFactoryMethodLinear(t){return new cc(this.times,this.values,this.getValueSize(),t)}};Go.prototype.ValueTypeName="quaternion";Go.prototype.InterpolantFactoryMethodSmooth=void 0;var Xi=class extends pn{constructor(t,e,i){super(t,e,i)}};Xi.prototype.ValueTypeName="string";Xi.prototype.ValueBufferType=Array;Xi.prototype.DefaultInterpolation=xo;Xi.prototype.InterpolantFactoryMethodLinear=void 0;Xi.prototype.InterpolantFactoryMethodSmooth=void 0;var hc=class extends pn{constructor(t,e,i,s){super(t,e,i,s)}};hc.prototype.ValueTypeName="vector";var uc=class{constructor(t,e,i){let s=this,r=!1,o=0,a=0,c,l=[];this.onStart=void 0,this.onLoad=t,this.onProgress=e,this.onError=i,this._abortController=null,this.itemStart=function(h){a++,r===!1&&s.onStart!==void 0&&s.onStart(h,o,a),r=!0},this.itemEnd=function(h){o++,s.onProgress!==void 0&&s.onProgress(h,o,a),o===a&&(r=!1,s.onLoad!==void 0&&s.onLoad())},this.itemError=function(h){s.onError!==void 0&&s.onError(h)},this.resolveURL=function(h){return h=h.normalize("NFC"),c?c(h):h},this.setURLModifier=function(h){return c=h,this},this.addHandler=function(h,u){return l.push(h,u),this},this.removeHandler=function(h){let u=l.indexOf(h);return u!==-1&&l.splice(u,2),this},this.getHandler=function(h){for(let u=0,f=l.length;u<f;u+=2){let d=l[u],m=l[u+1];if(d.global&&(d.lastIndex=0),d.test(h))return m}return null},this.abort=function(){return this.abortController.abort(),this._abortController=null,this}}get abortController(){return this._abortController||(this._abortController=new AbortController),this._abortController}},z0=new uc,fc=class{constructor(t){this.manager=t!==void 0?t:z0,this.crossOrigin="anonymous",this.withCredentials=!1,this.path="",this.resourcePath="",this.requestHeader={},this.priority="auto",this.cache="default",typeof __THREE_DEVTOOLS__<"u"&&__THREE_DEVTOOLS__.dispatchEvent(new CustomEvent("observe",{detail:this}))}load(){}loadAsync(t,e){let i=this;return new Promise(function(s,r){i.load(t,s,e,r)})}parse(){}setCrossOrigin(t){return this.crossOrigin=t,this}setWithCredentials(t){return this.withCredentials=t,this}setPath(t){return this.path=t,this}setResourcePath(t){return this.resourcePath=t,this}setRequestHeader(t){return this.requestHeader=t,this}setPriority(t){return this.priority=t,this}setCache(t){return this.cache=t,this}abort(){return this}};fc.DEFAULT_MATERIAL_NAME="__DEFAULT";var Ho=class extends De{static registerNode(t){this.prototype._lightNode=t}constructor(t,e=1){super(),this.isLight=!0,this.type="Light",this.color=new Gt(t),this.intensity=e}copy(t,e){return super.copy(t,e),this.color.copy(t.color),this.intensity=t.intensity,this}toJSON(t){let e=super.toJSON(t);return e.object.color=this.color.getHex(),e.object.intensity=this.intensity,e}};var cf=new re,Xg=new P,$g=new P,dc=class{constructor(t){this.camera=t,this.intensity=1,this.bias=0,this.biasNode=null,this.normalBias=0,this.radius=1,this.blurSamples=8,this.mapSize=new ht(512,512),this.mapType=rn,this.map=null,this.mapPass=null,this.matrix=new re,this.autoUpdate=!0,this.needsUpdate=!1,this._frustum=new Vi,this._frameExtents=new ht(1,1),this._viewportCount=1,this._viewports=[new oe(0,0,1,1)]}getViewportCount(){return this._viewportCount}getCamera(){return this.camera}getFrustum(){return this._frustum}updateMatrices(t){let e=this.camera;Xg.setFromMatrixPosition(t.matrixWorld),e.position.copy(Xg),$g.setFromMatrixPosition(t.target.matrixWorld),e.lookAt($g),e.updateMatrixWorld(),this._updateMatrix(e,this.matrix,this._frustum)}_updateMatrix(t,e,i,s){cf.multiplyMatrices(t.projectionMatrix,t.matrixWorldInverse),i.setFromProjectionMatrix(cf,t.coordinateSystem,t.reversedDepth);let r=this._frameExtents,o=s?s.z/r.x:1,a=s?s.w/r.y:1,c=s?s.x/r.x:0,l=s?s.y/r.y:0;t.coordinateSystem===vr||t.reversedDepth?e.set(.5*o,0,0,.5*o+c,0,.5*a,0,.5*a+l,0,0,1,0,0,0,0,1):e.set(.5*o,0,0,.5*o+c,0,.5*a,0,.5*a+l,0,0,.5,.5,0,0,0,1),e.multiply(cf)}getViewport(t){return this._viewports[t]}getFrameExtents(){return this._frameExtents}dispose(){this.map&&this.map.dispose(),this.mapPass&&this.mapPass.dispose()}copy(t){return this.camera=t.camera.clone(),this.intensity=t.intensity,this.bias=t.bias,this.radius=t.radius,this.autoUpdate=t.autoUpdate,this.needsUpdate=t.needsUpdate,this.normalBias=t.normalBias,this.blurSamples=t.blurSamples,this.mapSize.copy(t.mapSize),this.mapType=t.mapType,this.biasNode=t.biasNode,this}clone(){return new this.constructor().copy(this)}toJSON(){let t={};return t.intensity=this.intensity,t.bias=this.bias,t.normalBias=this.normalBias,t.radius=this.radius,t.blurSamples=this.blurSamples,t.mapSize=this.mapSize.toArray(),t.mapType=this.mapType,t.camera=this.camera.toJSON(!1).object,delete t.camera.matrix,t}},wl=new P,Al=new Ne,$n=new P,Wo=class extends De{constructor(){super(),this.isCamera=!0,this.type="Camera",this.matrixWorldInverse=new re,this.projectionMatrix=new re,this.projectionMatrixInverse=new re,this.coordinateSystem=wn,this._reversedDepth=!1}get reversedDepth(){return this._reversedDepth}copy(t,e){return super.copy(t,e),this.matrixWorldInverse.copy(t.matrixWorldInverse),this.projectionMatrix.copy(t.projectionMatrix),this.projectionMatrixInverse.copy(t.projectionMatrixInverse),this.coordinateSystem=t.coordinateSystem,this}getWorldDirection(t){return super.getWorldDirection(t).negate()}updateMatrixWorld(t){super.updateMatrixWorld(t),this.matrixWorld.decompose(wl,Al,$n),$n.x===1&&$n.y===1&&$n.z===1?this.matrixWorldInverse.copy(this.matrixWorld).invert():this.matrixWorldInverse.compose(wl,Al,$n.set(1,1,1)).invert()}updateWorldMatrix(t,e,i=!1){super.updateWorldMatrix(t,e,i),this.matrixWorld.decompose(wl,Al,$n),$n.x===1&&$n.y===1&&$n.z===1?this.matrixWorldInverse.copy(this.matrixWorld).invert():this.matrixWorldInverse.compose(wl,Al,$n.set(1,1,1)).invert()}clone(){return new this.constructor().copy(this)}},zi=new P,qg=new ht,Yg=new ht,je=class extends Wo{constructor(t=50,e=1,i=.1,s=2e3){super(),this.isPerspectiveCamera=!0,this.type="PerspectiveCamera",this.fov=t,this.zoom=1,this.near=i,this.far=s,this.focus=10,this.aspect=e,this.view=null,this.filmGauge=35,this.filmOffset=0,this.updateProjectionMatrix()}copy(t,e){return super.copy(t,e),this.fov=t.fov,this.zoom=t.zoom,this.near=t.near,this.far=t.far,this.focus=t.focus,this.aspect=t.aspect,this.view=t.view===null?null:Object.assign({},t.view),this.filmGauge=t.filmGauge,this.filmOffset=t.filmOffset,this}setFocalLength(t){let e=.5*this.getFilmHeight()/t;this.fov=Mr*2*Math.atan(e),this.updateProjectionMatrix()}getFocalLength(){let t=Math.tan(gr*.5*this.fov);return .5*this.getFilmHeight()/t}getEffectiveFOV(){return Mr*2*Math.atan(Math.tan(gr*.5*this.fov)/this.zoom)}getFilmWidth(){return this.filmGauge*Math.min(this.aspect,1)}getFilmHeight(){return this.filmGauge/Math.max(this.aspect,1)}getViewBounds(t,e,i){zi.set(-1,-1,.5).applyMatrix4(this.projectionMatrixInverse),e.set(zi.x,zi.y).multiplyScalar(-t/zi.z),zi.set(1,1,.5).applyMatrix4(this.projectionMatrixInverse),i.set(zi.x,zi.y).multiplyScalar(-t/zi.z)}getViewSize(t,e){return this.getViewBounds(t,qg,Yg),e.subVectors(Yg,qg)}setViewOffset(t,e,i,s,r,o){this.aspect=t/e,this.view===null&&(this.view={enabled:!0,fullWidth:1,fullHeight:1,offsetX:0,offsetY:0,width:1,height:1}),this.view.enabled=!0,this.view.fullWidth=t,this.view.fullHeight=e,this.view.offsetX=i,this.view.offsetY=s,this.view.width=r,this.view.height=o,this.updateProjectionMatrix()}clearViewOffset(){this.view!==null&&(this.view.enabled=!1),this.updateProjectionMatrix()}updateProjectionMatrix(){let t=this.near,e=t*Math.tan(gr*.5*this.fov)/this.zoom,i=2*e,s=this.aspect*i,r=-.5*s,o=this.view;if(this.view!==null&&this.view.enabled){let c=o.fullWidth,l=o.fullHeight;r+=o.offsetX*s/c,e-=o.offsetY*i/l,s*=o.width/c,i*=o.height/l}let a=this.filmOffset;a!==0&&(r+=t*a/this.getFilmWidth()),this.projectionMatrix.makePerspective(r,r+s,e,e-i,t,this.far,this.coordinateSystem,this.reversedDepth),this.projectionMatrixInverse.copy(this.projectionMatrix).invert()}toJSON(t){let e=super.toJSON(t);return e.object.fov=this.fov,e.object.zoom=this.zoom,e.object.near=this.near,e.object.far=this.far,e.object.focus=this.focus,e.object.aspect=this.aspect,this.view!==null&&(e.object.view=Object.assign({},this.view)),e.object.filmGauge=this.filmGauge,e.object.filmOffset=this.filmOffset,e}};var Xo=class extends Wo{constructor(t=-1,e=1,i=1,s=-1,r=.1,o=2e3){super(),this.isOrthographicCamera=!0,this.type="OrthographicCamera",this.zoom=1,this.view=null,this.left=t,this.right=e,this.top=i,this.bottom=s,this.near=r,this.far=o,this.updateProjectionMatrix()}copy(t,e){return super.copy(t,e),this.left=t.left,this.right=t.right,this.top=t.top,this.bottom=t.bottom,this.near=t.near,this.far=t.far,this.zoom=t.zoom,this.view=t.view===null?null:Object.assign({},t.view),this}setViewOffset(t,e,i,s,r,o){this.view===null&&(this.view={enabled:!0,fullWidth:1,fullHeight:1,offsetX:0,offsetY:0,width:1,height:1}),this.view.enabled=!0,this.view.fullWidth=t,this.view.fullHeight=e,this.view.offsetX=i,this.view.offsetY=s,this.view.width=r,this.view.height=o,this.updateProjectionMatrix()}clearViewOffset(){this.view!==null&&(this.view.enabled=!1),this.updateProjectionMatrix()}updateProjectionMatrix(){let t=(this.right-this.left)/(2*this.zoom),e=(this.top-this.bottom)/(2*this.zoom),i=(this.right+this.left)/2,s=(this.top+this.bottom)/2,r=i-t,o=i+t,a=s+e,c=s-e;if(this.view!==null&&this.view.enabled){let l=(this.right-this.left)/this.view.fullWidth/this.zoom,h=(this.top-this.bottom)/this.view.fullHeight/this.zoom;r+=l*this.view.offsetX,o=r+l*this.view.width,a-=h*this.view.offsetY,c=a-h*this.view.height}this.projectionMatrix.makeOrthographic(r,o,a,c,this.near,this.far,this.coordinateSystem,this.reversedDepth),this.projectionMatrixInverse.copy(this.projectionMatrix).invert()}toJSON(t){let e=super.toJSON(t);return e.object.zoom=this.zoom,e.object.left=this.left,e.object.right=this.right,e.object.top=this.top,e.object.bottom=this.bottom,e.object.near=this.near,e.object.far=this.far,this.view!==null&&(e.object.view=Object.assign({},this.view)),e}},yf=class extends dc{constructor(){super(new Xo(-5,5,5,-5,.5,500)),this.isDirectionalLightShadow=!0}},$o=class extends Ho{constructor(t,e){super(t,e),this.isDirectionalLight=!0,this.type="DirectionalLight",this.position.copy(De.DEFAULT_UP),this.updateMatrix(),this.target=new De,this.shadow=new yf}dispose(){super.dispose(),this.shadow.dispose()}copy(t){return super.copy(t),this.target=t.target.clone(),this.shadow=t.shadow.clone(),this}toJSON(t){let e=super.toJSON(t);return e.object.shadow=this.shadow.toJSON(),e.object.target=this.target.uuid,e}},qo=class extends Ho{constructor(t,e){super(t,e),this.isAmbientLight=!0,this.type="AmbientLight"}};var Yo=class extends ae{constructor(){super(),this.isInstancedBufferGeometry=!0,this.type="InstancedBufferGeometry",this.instanceCount=1/0}copy(t){return super.copy(t),this.instanceCount=t.instanceCount,this}toJSON(){let t=super.toJSON();return t.instanceCount=this.instanceCount,t.isInstancedBufferGeometry=!0,t}};var fr=-90,dr=1,Lr=class extends De{constructor(t,e,i){super(),this.type="CubeCamera",this.renderTarget=i,this.coordinateSystem=null,this.activeMipmapLevel=0;let s=new je(fr,dr,t,e);s.layers=this.layers,this.add(s);let r=new je(fr,dr,t,e);r.layers=this.layers,this.add(r);let o=new je(fr,dr,t,e);o.layers=this.layers,this.add(o);let a=new je(fr,dr,t,e);a.layers=this.layers,this.add(a);let c=new je(fr,dr,t,e);c.layers=this.layers,this.add(c);let l=new je(fr,dr,t,e);l.layers=this.layers,this.add(l)}updateCoordinateSystem(){let t=this.coordinateSystem,e=this.children.concat(),[i,s,r,o,a,c]=e;for(let l of e)this.remove(l);if(t===wn)i.up.set(0,1,0),i.lookAt(1,0,0),s.up.set(0,1,0),s.lookAt(-1,0,0),r.up.set(0,0,-1),r.lookAt(0,1,0),o.up.set(0,0,1),o.lookAt(0,-1,0),a.up.set(0,1,0),a.lookAt(0,0,1),c.up.set(0,1,0),c.lookAt(0,0,-1);else if(t===vr)i.up.set(0,-1,0),i.lookAt(-1,0,0),s.up.set(0,-1,0),s.lookAt(1,0,0),r.up.set(0,0,1),r.lookAt(0,1,0),o.up.set(0,0,-1),o.lookAt(0,-1,0),a.up.set(0,-1,0),a.lookAt(0,0,1),c.up.set(0,-1,0),c.lookAt(0,0,-1);else throw new Error("THREE.CubeCamera.updateCoordinateSystem(): Invalid coordinate system: "+t);for(let l of e)this.add(l),l.updateMatrixWorld()}update(t,e){this.parent===null&&this.updateMatrixWorld();let{renderTarget:i,activeMipmapLevel:s}=this;this.coordinateSystem!==t.coordinateSystem&&(this.coordinateSystem=t.coordinateSystem,this.updateCoordinateSystem());let[r,o,a,c,l,h]=this.children,u=t.getRenderTarget(),f=t.getActiveCubeFace(),d=t.getActiveMipmapLevel(),m=t.xr.enabled;t.xr.enabled=!1;let _=i.texture.mipmapsAutoUpdate;i.texture.mipmapsAutoUpdate=!1;let p=!1;t.isWebGLRenderer===!0?p=t.state.buffers.depth.getReversed():p=t.reversedDepthBuffer,t.setRenderTarget(i,0,s),p&&t.autoClear===!1&&t.clearDepth(),t.render(e,r),t.setRenderTarget(i,1,s),p&&t.autoClear===!1&&t.clearDepth(),t.render(e,o),t.setRenderTarget(i,2,s),p&&t.autoClear===!1&&t.clearDepth(),t.render(e,a),t.setRenderTarget(i,3,s),p&&t.autoClear===!1&&t.clearDepth(),t.render(e,c),t.setRenderTarget(i,4,s),p&&t.autoClear===!1&&t.clearDepth(),t.render(e,l),i.texture.mipmapsAutoUpdate=_,t.setRenderTarget(i,5,s),p&&t.autoClear===!1&&t.clearDepth(),t.render(e,h),t.setRenderTarget(u,f,d),t.xr.enabled=m,i.texture.needsPMREMUpdate=!0}},pc=class extends je{constructor(t=[]){super(),this.isArrayCamera=!0,this.isMultiViewCamera=!1,this.cameras=t,this.perCameraFrustumCulled=!1}};var ed="\\[\\]\\.:\\/",Hb=new RegExp("["+ed+"]","g"),nd="[^"+ed+"]",Wb="[^"+ed.replace("\\.","")+"]",Xb=/((?:WC+[\/:])*)/.source.replace("WC",nd),$b=/(WCOD+)?/.source.replace("WCOD",Wb),qb=/(?:\.(WC+)(?:\[(.+)\])?)?/.source.replace("WC",nd),Yb=/\.(WC+)(?:\[(.+)\])?/.source.replace("WC",nd),Zb=new RegExp("^"+Xb+$b+qb+Yb+"$"),Jb=["material","materials","bones","map"],vf=class{constructor(t,e,i){let s=i||fe.parseTrackName(e);this._targetGroup=t,this._bindings=t.subscribe_(e,s)}getValue(t,e){this.bind();let i=this._targetGroup.nCachedObjects_,s=this._bindings[i];s!==void 0&&s.getValue(t,e)}setValue(t,e){let i=this._bindings;for(let s=this._targetGroup.nCachedObjects_,r=i.length;s!==r;++s)i[s].setValue(t,e)}bind(){let t=this._bindings;for(let e=this._targetGroup.nCachedObjects_,i=t.length;e!==i;++e)t[e].bind()}unbind(){let t=this._bindings;for(let e=this._targetGroup.nCachedObjects_,i=t.length;e!==i;++e)t[e].unbind()}},fe=class n{constructor(t,e,i){this.path=e,this.parsedPath=i||n.parseTrackName(e),this.node=n.findNode(t,this.parsedPath.nodeName),this.rootNode=t,this.getValue=this._getValue_unbound,this.setValue=this._setValue_unbound}static create(t,e,i){return t&&t.isAnimationObjectGroup?new n.Composite(t,e,i):new n(t,e,i)}static sanitizeNodeName(t){return t.replace(/\s/g,"_").replace(Hb,"")}static parseTrackName(t){let e=Zb.exec(t);if(e===null)throw new Error("THREE.PropertyBinding: Cannot parse trackName: "+t);let i={nodeName:e[2],objectName:e[3],objectIndex:e[4],propertyName:e[5],propertyIndex:e[6]},s=i.nodeName&&i.nodeName.lastIndexOf(".");if(s!==void 0&&s!==-1){let r=i.nodeName.substring(s+1);Jb.indexOf(r)!==-1&&(i.nodeName=i.nodeName.substring(0,s),i.objectName=r)}if(i.propertyName===null||i.propertyName.length===0)throw new Error("THREE.PropertyBinding: can not parse propertyName from trackName: "+t);return i}static findNode(t,e){if(e===void 0||e===""||e==="."||e===-1||e===t.name||e===t.uuid)return t;if(t.skeleton){let i=t.skeleton.getBoneByName(e);if(i!==void 0)return i}if(t.children){let i=function(r){for(let o=0;o<r.length;o++){let a=r[o];if(a.name===e||a.uuid===e)return a;let c=i(a.children);if(c)return c}return null},s=i(t.children);if(s)return s}return null}_getValue_unavailable(){}_setValue_unavailable(){}_getValue_direct(t,e){t[e]=this.targetObject[this.propertyName]}_getValue_array(t,e){let i=this.resolvedProperty;for(let s=0,r=i.length;s!==r;++s)t[e++]=i[s]}_getValue_arrayElement(t,e){t[e]=this.resolvedProperty[this.propertyIndex]}_getValue_toArray(t,e){this.resolvedProperty.toArray(t,e)}_setValue_direct(t,e){this.targetObject[this.propertyName]=t[e]}_setValue_direct_setNeedsUpdate(t,e){this.targetObject[this.propertyName]=t[e],this.targetObject.needsUpdate=!0}_setValue_direct_setMatrixWorldNeedsUpdate(t,e){this.targetObject[this.propertyName]=t[e],this.targetObject.matrixWorldNeedsUpdate=!0}_setValue_array(t,e){let i=this.resolvedProperty;for(let s=0,r=i.length;s!==r;++s)i[s]=t[e++]}_setValue_array_setNeedsUpdate(t,e){let i=this.resolvedProperty;for(let s=0,r=i.length;s!==r;++s)i[s]=t[e++];this.targetObject.needsUpdate=!0}_setValue_array_setMatrixWorldNeedsUpdate(t,e){let i=this.resolvedProperty;for(let s=0,r=i.length;s!==r;++s)i[s]=t[e++];this.targetObject.matrixWorldNeedsUpdate=!0}_setValue_arrayElement(t,e){this.resolvedProperty[this.propertyIndex]=t[e]}_setValue_arrayElement_setNeedsUpdate(t,e){this.resolvedProperty[this.propertyIndex]=t[e],this.targetObject.needsUpdate=!0}_setValue_arrayElement_setMatrixWorldNeedsUpdate(t,e){this.resolvedProperty[this.propertyIndex]=t[e],this.targetObject.matrixWorldNeedsUpdate=!0}_setValue_fromArray(t,e){this.resolvedProperty.fromArray(t,e)}_setValue_fromArray_setNeedsUpdate(t,e){this.resolvedProperty.fromArray(t,e),this.targetObject.needsUpdate=!0}_setValue_fromArray_setMatrixWorldNeedsUpdate(t,e){this.resolvedProperty.fromArray(t,e),this.targetObject.matrixWorldNeedsUpdate=!0}_getValue_unbound(t,e){this.bind(),this.getValue(t,e)}_setValue_unbound(t,e){this.bind(),this.setValue(t,e)}bind(){let t=this.node,e=this.parsedPath,i=e.objectName,s=e.propertyName,r=e.propertyIndex;if(t||(t=n.findNode(this.rootNode,e.nodeName),this.node=t),this.getValue=this._getValue_unavailable,this.setValue=this._setValue_unavailable,!t){Nt("PropertyBinding: No target node found for track: "+this.path+".");return}if(i){let l=e.objectIndex;switch(i){case"materials":if(!t.material){Ot("PropertyBinding: Can not bind to material as node does not have a material.",this);return}if(!t.material.materials){Ot("PropertyBinding: Can not bind to material.materials as node.material does not have a materials array.",this);return}t=t.material.materials;break;case"bones":if(!t.skeleton){Ot("PropertyBinding: Can not bind to bones as node does not have a skeleton.",this);return}t=t.skeleton.bones;for(let h=0;h<t.length;h++)if(t[h].name===l){l=h;break}break;case"map":if("map"in t){t=t.map;break}if(!t.material){Ot("PropertyBinding: Can not bind to material as node does not have a material.",this);return}if(!t.material.map){Ot("PropertyBinding: Can not bind to material.map as node.material does not have a map.",this);return}t=t.material.map;break;default:if(t[i]===void 0){Ot("PropertyBinding: Can not bind to objectName of node undefined.",this);return}t=t[i]}if(l!==void 0){if(t[l]===void 0){Ot("PropertyBinding: Trying to bind to objectIndex of objectName, but is undefined.",this,t);return}t=t[l]}}let o=t[s];if(o===void 0){let l=e.nodeName;Ot("PropertyBinding: Trying to update property for track: "+l+"."+s+" but it wasn't found.",t);return}let a=this.Versioning.None;this.targetObject=t,t.isMaterial===!0?a=this.Versioning.NeedsUpdate:t.isObject3D===!0&&(a=this.Versioning.MatrixWorldNeedsUpdate);let c=this.BindingType.Direct;if(r!==void 0){if(s==="morphTargetInfluences"){if(!t.geometry){Ot("PropertyBinding: Can not bind to morphTargetInfluences because node does not have a geometry.",this);return}if(!t.geometry.morphAttributes){Ot("PropertyBinding: Can not bind to morphTargetInfluences because node does not have a geometry.morphAttributes.",this);return}t.morphTargetDictionary[r]!==void 0&&(r=t.morphTargetDictionary[r])}c=this.BindingType.ArrayElement,this.resolvedProperty=o,this.propertyIndex=r}else o.fromArray!==void 0&&o.toArray!==void 0?(c=this.BindingType.HasFromToArray,this.resolvedProperty=o):Array.isArray(o)?(c=this.BindingType.EntireArray,this.resolvedProperty=o):this.propertyName=s;this.getValue=this.GetterByBindingType[c],this.setValue=this.SetterByBindingTypeAndVersioning[c][a]}unbind(){this.node=null,this.getValue=this._getValue_unbound,this.setValue=this._setValue_unbound}};fe.Composite=vf;fe.prototype.BindingType={Direct:0,EntireArray:1,ArrayElement:2,HasFromToArray:3};fe.prototype.Versioning={None:0,NeedsUpdate:1,MatrixWorldNeedsUpdate:2};fe.prototype.GetterByBindingType=[fe.prototype._getValue_direct,fe.prototype._getValue_array,fe.prototype._getValue_arrayElement,fe.prototype._getValue_toArray];fe.prototype.SetterByBindingTypeAndVersioning=[[fe.prototype._setValue_direct,fe.prototype._setValue_direct_setNeedsUpdate,fe.prototype._setValue_direct_setMatrixWorldNeedsUpdate],[fe.prototype._setValue_array,fe.prototype._setValue_array_setNeedsUpdate,fe.prototype._setValue_array_setMatrixWorldNeedsUpdate],[fe.prototype._setValue_arrayElement,fe.prototype._setValue_arrayElement_setNeedsUpdate,fe.prototype._setValue_arrayElement_setMatrixWorldNeedsUpdate],[fe.prototype._setValue_fromArray,fe.prototype._setValue_fromArray_setNeedsUpdate,fe.prototype._setValue_fromArray_setMatrixWorldNeedsUpdate]];var f2=new Float32Array(1);var $i=class extends Gl{constructor(t,e,i=1){super(t,e),this.isInstancedInterleavedBuffer=!0,this.meshPerAttribute=i}copy(t){return super.copy(t),this.meshPerAttribute=t.meshPerAttribute,this}clone(t){let e=super.clone(t);return e.meshPerAttribute=this.meshPerAttribute,e}toJSON(t){let e=super.toJSON(t);return e.isInstancedInterleavedBuffer=!0,e.meshPerAttribute=this.meshPerAttribute,e}};var Zg=new re,Zo=class{constructor(t,e,i=0,s=1/0){this.ray=new gi(t,e),this.near=i,this.far=s,this.camera=null,this.layers=new wr,this.params={Mesh:{},Line:{threshold:1},LOD:{},Points:{threshold:1},Sprite:{}}}set(t,e){this.ray.set(t,e)}setFromCamera(t,e){e.isPerspectiveCamera?(this.ray.origin.setFromMatrixPosition(e.matrixWorld),this.ray.direction.set(t.x,t.y,.5).unproject(e).sub(this.ray.origin).normalize(),this.camera=e):e.isOrthographicCamera?(this.ray.origin.set(t.x,t.y,e.projectionMatrix.elements[14]).unproject(e),this.ray.direction.set(0,0,-1).transformDirection(e.matrixWorld),this.camera=e):Ot("Raycaster: Unsupported camera type: "+e.type)}setFromXRController(t){return Zg.identity().extractRotation(t.matrixWorld),this.ray.origin.setFromMatrixPosition(t.matrixWorld),this.ray.direction.set(0,0,-1).applyMatrix4(Zg),this}intersectObject(t,e=!0,i=[]){return bf(t,this,i,e),i.sort(Jg),i}intersectObjects(t,e=!0,i=[]){for(let s=0,r=t.length;s<r;s++)bf(t[s],this,i,e);return i.sort(Jg),i}};function Jg(n,t){return n.distance-t.distance}function bf(n,t,e,i){let s=!0;if(n.layers.test(t.layers)&&n.raycast(t,e)===!1&&(s=!1),s===!0&&i===!0){let r=n.children;for(let o=0,a=r.length;o<a;o++)bf(r[o],t,e,!0)}}var Nr=class{constructor(t=1,e=0,i=0){this.radius=t,this.phi=e,this.theta=i}set(t,e,i){return this.radius=t,this.phi=e,this.theta=i,this}copy(t){return this.radius=t.radius,this.phi=t.phi,this.theta=t.theta,this}makeSafe(){return this.phi=Ft(this.phi,1e-6,Math.PI-1e-6),this}setFromVector3(t){return this.setFromCartesianCoords(t.x,t.y,t.z)}setFromCartesianCoords(t,e,i){return this.radius=Math.sqrt(t*t+e*e+i*i),this.radius===0?(this.theta=0,this.phi=0):(this.theta=Math.atan2(t,i),this.phi=Math.acos(Ft(e/this.radius,-1,1))),this}clone(){return new this.constructor().copy(this)}};var Mf=class{static{this.prototype.isMatrix2=!0}constructor(t,e,i,s){this.elements=[1,0,0,1],t!==void 0&&this.set(t,e,i,s)}identity(){return this.set(1,0,0,1),this}fromArray(t,e=0){for(let i=0;i<4;i++)this.elements[i]=t[i+e];return this}set(t,e,i,s){let r=this.elements;return r[0]=t,r[2]=e,r[1]=i,r[3]=s,this}};var jg=new P,El=new P,pr=new P,mr=new P,hf=new P,jb=new P,Kb=new P,Jo=class{constructor(t=new P,e=new P){this.start=t,this.end=e}set(t,e){return this.start.copy(t),this.end.copy(e),this}copy(t){return this.start.copy(t.start),this.end.copy(t.end),this}getCenter(t){return t.addVectors(this.start,this.end).multiplyScalar(.5)}delta(t){return t.subVectors(this.end,this.start)}distanceSq(){return this.start.distanceToSquared(this.end)}distance(){return this.start.distanceTo(this.end)}at(t,e){return this.delta(e).multiplyScalar(t).add(this.start)}closestPointToPointParameter(t,e){jg.subVectors(t,this.start),El.subVectors(this.end,this.start);let i=El.dot(El);if(i===0)return 0;let r=El.dot(jg)/i;return e&&(r=Ft(r,0,1)),r}closestPointToPoint(t,e,i){let s=this.closestPointToPointParameter(t,e);return this.delta(i).multiplyScalar(s).add(this.start)}distanceSqToLine3(t,e=jb,i=Kb){let s=10000000000000001e-32,r,o,a=this.start,c=t.start,l=this.end,h=t.end;pr.subVectors(l,a),mr.subVectors(h,c),hf.subVectors(a,c);let u=pr.dot(pr),f=mr.dot(mr),d=mr.dot(hf);if(u<=s&&f<=s)return e.copy(a),i.copy(c),e.distanceToSquared(i);if(u<=s)r=0,o=d/f,o=Ft(o,0,1);else{let m=pr.dot(hf);if(f<=s)o=0,r=Ft(-m/u,0,1);else{let _=pr.dot(mr),p=u*f-_*_;p!==0?r=Ft((_*d-m*f)/p,0,1):r=0,o=(_*r+d)/f,o<0?(o=0,r=Ft(-m/u,0,1)):o>1&&(o=1,r=Ft((_-m)/u,0,1))}}return e.copy(a).addScaledVector(pr,r),i.copy(c).addScaledVector(mr,o),e.distanceToSquared(i)}applyMatrix4(t){return this.start.applyMatrix4(t),this.end.applyMatrix4(t),this}equals(t){return t.start.equals(this.start)&&t.end.equals(this.end)}clone(){return new this.constructor().copy(this)}};var jo=class extends Fn{constructor(t,e=null){super(),this.object=t,this.domElement=e,this.enabled=!0,this.state=-1,this.keys={},this.mouseButtons={LEFT:null,MIDDLE:null,RIGHT:null},this.touches={ONE:null,TWO:null}}connect(t){this.domElement!==null&&this.disconnect(),this.domElement=t}disconnect(){}dispose(){}update(){}};function id(n,t,e,i){let s=Qb(i);switch(e){case Vf:return n*t;case Hf:return n*t/s.components*s.byteLength;case Mc:return n*t/s.components*s.byteLength;case Ji:return n*t*2/s.components*s.byteLength;case Sc:return n*t*2/s.components*s.byteLength;case Gf:return n*t*3/s.components*s.byteLength;case Gn:return n*t*4/s.components*s.byteLength;case wc:return n*t*4/s.components*s.byteLength;case ta:case ea:return Math.floor((n+3)/4)*Math.floor((t+3)/4)*8;case na:case ia:return Math.floor((n+3)/4)*Math.floor((t+3)/4)*16;case Ec:case Cc:return Math.max(n,16)*Math.max(t,8)/4;case Ac:case Tc:return Math.max(n,8)*Math.max(t,8)/2;case Rc:case Pc:case Lc:case Nc:return Math.floor((n+3)/4)*Math.floor((t+3)/4)*8;case Ic:case sa:case Dc:return Math.floor((n+3)/4)*Math.floor((t+3)/4)*16;case Uc:return Math.floor((n+3)/4)*Math.floor((t+3)/4)*16;case Oc:return Math.floor((n+4)/5)*Math.floor((t+3)/4)*16;case Fc:return Math.floor((n+4)/5)*Math.floor((t+4)/5)*16;case Bc:return Math.floor((n+5)/6)*Math.floor((t+4)/5)*16;case kc:return Math.floor((n+5)/6)*Math.floor((t+5)/6)*16;case zc:return Math.floor((n+7)/8)*Math.floor((t+4)/5)*16;case Vc:return Math.floor((n+7)/8)*Math.floor((t+5)/6)*16;case Gc:return Math.floor((n+7)/8)*Math.floor((t+7)/8)*16;case Hc:return Math.floor((n+9)/10)*Math.floor((t+4)/5)*16;case Wc:return Math.floor((n+9)/10)*Math.floor((t+5)/6)*16;case Xc:return Math.floor((n+9)/10)*Math.floor((t+7)/8)*16;case $c:return Math.floor((n+9)/10)*Math.floor((t+9)/10)*16;case qc:return Math.floor((n+11)/12)*Math.floor((t+9)/10)*16;case Yc:return Math.floor((n+11)/12)*Math.floor((t+11)/12)*16;case Zc:case Jc:case jc:return Math.ceil(n/4)*Math.ceil(t/4)*16;case Kc:case Qc:return Math.ceil(n/4)*Math.ceil(t/4)*8;case ra:case th:return Math.ceil(n/4)*Math.ceil(t/4)*16}throw new Error(`Unable to determine texture byte length for ${e} format.`)}function Qb(n){switch(n){case rn:case Ff:return{byteLength:1,components:1};case Fr:case Bf:case Vn:return{byteLength:2,components:1};case vc:case bc:return{byteLength:2,components:4};case kn:case yc:case zn:return{byteLength:4,components:1};case kf:case zf:return{byteLength:4,components:3}}throw new Error(`THREE.TextureUtils: Unknown texture type ${n}.`)}typeof __THREE_DEVTOOLS__<"u"&&__THREE_DEVTOOLS__.dispatchEvent(new CustomEvent("register",{detail:{revision:"187"}}));typeof window<"u"&&(window.__THREE__?Nt("WARNING: Multiple instances of Three.js being imported."):window.__THREE__="187");function l_(){let n=null,t=!1,e=null,i=null;function s(r,o){i=n.requestAnimationFrame(s),e(r,o)}return{start:function(){t!==!0&&e!==null&&n!==null&&(i=n.requestAnimationFrame(s),t=!0)},stop:function(){n!==null&&n.cancelAnimationFrame(i),t=!1},setAnimationLoop:function(r){e=r},setContext:function(r){n=r}}}function eM(n){let t=new WeakMap;function e(a,c){let l=a.array,h=a.usage,u=l.byteLength,f=n.createBuffer();n.bindBuffer(c,f),n.bufferData(c,l,h),a.onUploadCallback();let d;if(l instanceof Float32Array)d=n.FLOAT;else if(typeof Float16Array<"u"&&l instanceof Float16Array)d=n.HALF_FLOAT;else if(l instanceof Uint16Array)a.isFloat16BufferAttribute?d=n.HALF_FLOAT:d=n.UNSIGNED_SHORT;else if(l instanceof Int16Array)d=n.SHORT;else if(l instanceof Uint32Array)d=n.UNSIGNED_INT;else if(l instanceof Int32Array)d=n.INT;else if(l instanceof Int8Array)d=n.BYTE;else if(l instanceof Uint8Array)d=n.UNSIGNED_BYTE;else if(l instanceof Uint8ClampedArray)d=n.UNSIGNED_BYTE;else throw new Error("THREE.WebGLAttributes: Unsupported buffer data format: "+l);return{buffer:f,type:d,bytesPerElement:l.BYTES_PER_ELEMENT,version:a.version,size:u}}function i(a,c,l){let h=c.array,u=c.updateRanges;if(n.bindBuffer(l,a),u.length===0)n.bufferSubData(l,0,h);else{u.sort((d,m)=>d.start-m.start);let f=0;for(let d=1;d<u.length;d++){let m=u[f],_=u[d];_.start<=m.start+m.count+1?m.count=Math.max(m.count,_.start+_.count-m.start):(++f,u[f]=_)}u.length=f+1;for(let d=0,m=u.length;d<m;d++){let _=u[d];n.bufferSubData(l,_.start*h.BYTES_PER_ELEMENT,h,_.start,_.count)}c.clearUpdateRanges()}c.onUploadCallback()}function s(a){return a.isInterleavedBufferAttribute&&(a=a.data),t.get(a)}function r(a){a.isInterleavedBufferAttribute&&(a=a.data);let c=t.get(a);c&&(n.deleteBuffer(c.buffer),t.delete(a))}function o(a,c){if(a.isInterleavedBufferAttribute&&(a=a.data),a.isGLBufferAttribute){let h=t.get(a);(!h||h.version<a.version)&&t.set(a,{buffer:a.buffer,type:a.type,bytesPerElement:a.elementSize,version:a.version});return}let l=t.get(a);if(l===void 0)t.set(a,e(a,c));else if(l.version<a.version){if(l.size!==a.array.byteLength)throw new Error("THREE.WebGLAttributes: The size of the buffer attribute's array buffer does not match the original size. Resizing buffer attributes is not supported.");i(l.buffer,a,c),l.version=a.version}}return{get:s,remove:r,update:o}}var nM=`#ifdef USE_ALPHAHASH
	if ( diffuseColor.a < getAlphaHashThreshold( vPosition ) ) discard;
#endif`,iM=`#ifdef USE_ALPHAHASH
	const float ALPHA_HASH_SCALE = 0.05;
	float hash2D( vec2 value ) {
		return fract( 1.0e4 * sin( 17.0 * value.x + 0.1 * value.y ) * ( 0.1 + abs( sin( 13.0 * value.y + value.x ) ) ) );
	}
	float hash3D( vec3 value ) {
		return hash2D( vec2( hash2D( value.xy ), value.z ) );
	}
	float getAlphaHashThreshold( vec3 position ) {
		float maxDeriv = max(
			length( dFdx( position.xyz ) ),
			length( dFdy( position.xyz ) )
		);
		float pixScale = 1.0 / ( ALPHA_HASH_SCALE * maxDeriv );
		vec2 pixScales = vec2(
			exp2( floor( log2( pixScale ) ) ),
			exp2( ceil( log2( pixScale ) ) )
		);
		vec2 alpha = vec2(
			hash3D( floor( pixScales.x * position.xyz ) ),
			hash3D( floor( pixScales.y * position.xyz ) )
		);
		float lerpFactor = fract( log2( pixScale ) );
		float x = ( 1.0 - lerpFactor ) * alpha.x + lerpFactor * alpha.y;
		float a = min( lerpFactor, 1.0 - lerpFactor );
		vec3 cases = vec3(
			x * x / ( 2.0 * a * ( 1.0 - a ) ),
			( x - 0.5 * a ) / ( 1.0 - a ),
			1.0 - ( ( 1.0 - x ) * ( 1.0 - x ) / ( 2.0 * a * ( 1.0 - a ) ) )
		);
		float threshold = ( x < ( 1.0 - a ) )
			? ( ( x < a ) ? cases.x : cases.y )
			: cases.z;
		return clamp( threshold , 1.0e-6, 1.0 );
	}
#endif`,sM=`#ifdef USE_ALPHAMAP
	diffuseColor.a *= texture2D( alphaMap, vAlphaMapUv ).g;
#endif`,rM=`#ifdef USE_ALPHAMAP
	uniform sampler2D alphaMap;
#endif`,oM=`#ifdef USE_ALPHATEST
	#ifdef ALPHA_TO_COVERAGE
	diffuseColor.a = smoothstep( alphaTest, alphaTest + fwidth( diffuseColor.a ), diffuseColor.a );
	if ( diffuseColor.a == 0.0 ) discard;
	#else
	if ( diffuseColor.a < alphaTest ) discard;
	#endif
#endif`,aM=`#ifdef USE_ALPHATEST
	uniform float alphaTest;
#endif`,lM=`#ifdef USE_AOMAP
	float ambientOcclusion = ( texture2D( aoMap, vAoMapUv ).r - 1.0 ) * aoMapIntensity + 1.0;
	reflectedLight.indirectDiffuse *= ambientOcclusion;
	#if defined( USE_CLEARCOAT ) 
		clearcoatSpecularIndirect *= ambientOcclusion;
	#endif
	#if defined( USE_SHEEN ) 
		sheenSpecularIndirect *= ambientOcclusion;
	#endif
	#if defined( USE_ENVMAP ) && defined( STANDARD )
		float dotNV = saturate( dot( geometryNormal, geometryViewDir ) );
		reflectedLight.indirectSpecular *= computeSpecularOcclusion( dotNV, ambientOcclusion, material.roughness );
	#endif
#endif`,cM=`#ifdef USE_AOMAP
	uniform sampler2D aoMap;
	uniform float aoMapIntensity;
#endif`,hM=`#ifdef USE_BATCHING
	#if ! defined( GL_ANGLE_multi_draw )
	#define gl_DrawID _gl_DrawID
	uniform int _gl_DrawID;
	#endif
	uniform highp sampler2D batchingTexture;
	uniform highp usampler2D batchingIdTexture;
	mat4 getBatchingMatrix( const in float i ) {
		int size = textureSize( batchingTexture, 0 ).x;
		int j = int( i ) * 4;
		int x = j % size;
		int y = j / size;
		vec4 v1 = texelFetch( batchingTexture, ivec2( x, y ), 0 );
		vec4 v2 = texelFetch( batchingTexture, ivec2( x + 1, y ), 0 );
		vec4 v3 = texelFetch( batchingTexture, ivec2( x + 2, y ), 0 );
		vec4 v4 = texelFetch( batchingTexture, ivec2( x + 3, y ), 0 );
		return mat4( v1, v2, v3, v4 );
	}
	float getIndirectIndex( const in int i ) {
		int size = textureSize( batchingIdTexture, 0 ).x;
		int x = i % size;
		int y = i / size;
		return float( texelFetch( batchingIdTexture, ivec2( x, y ), 0 ).r );
	}
#endif
#ifdef USE_BATCHING_COLOR
	uniform sampler2D batchingColorTexture;
	vec4 getBatchingColor( const in float i ) {
		int size = textureSize( batchingColorTexture, 0 ).x;
		int j = int( i );
		int x = j % size;
		int y = j / size;
		return texelFetch( batchingColorTexture, ivec2( x, y ), 0 );
	}
#endif`,uM=`#ifdef USE_BATCHING
	mat4 batchingMatrix = getBatchingMatrix( getIndirectIndex( gl_DrawID ) );
#endif`,fM=`vec3 transformed = vec3( position );
#ifdef USE_ALPHAHASH
	vPosition = vec3( position );
#endif`,dM=`vec3 objectNormal = vec3( normal );
#ifdef USE_TANGENT
	vec3 objectTangent = vec3( tangent.xyz );
#endif`,pM=`float G_BlinnPhong_Implicit( ) {
	return 0.25;
}
float D_BlinnPhong( const in float shininess, const in float dotNH ) {
	return RECIPROCAL_PI * ( shininess * 0.5 + 1.0 ) * pow( dotNH, shininess );
}
vec3 BRDF_BlinnPhong( const in vec3 lightDir, const in vec3 viewDir, const in vec3 normal, const in vec3 specularColor, const in float shininess ) {
	vec3 halfDir = normalize( lightDir + viewDir );
	float dotNH = saturate( dot( normal, halfDir ) );
	float dotVH = saturate( dot( viewDir, halfDir ) );
	vec3 F = F_Schlick( specularColor, 1.0, dotVH );
	float G = G_BlinnPhong_Implicit( );
	float D = D_BlinnPhong( shininess, dotNH );
	return F * ( G * D );
} // validated`,mM=`#ifdef USE_IRIDESCENCE
	const mat3 XYZ_TO_REC709 = mat3(
		 3.2404542, -0.9692660,  0.0556434,
		-1.5371385,  1.8760108, -0.2040259,
		-0.4985314,  0.0415560,  1.0572252
	);
	vec3 Fresnel0ToIor( vec3 fresnel0 ) {
		vec3 sqrtF0 = sqrt( fresnel0 );
		return ( vec3( 1.0 ) + sqrtF0 ) / ( vec3( 1.0 ) - sqrtF0 );
	}
	vec3 IorToFresnel0( vec3 transmittedIor, float incidentIor ) {
		return pow2( ( transmittedIor - vec3( incidentIor ) ) / ( transmittedIor + vec3( incidentIor ) ) );
	}
	float IorToFresnel0( float transmittedIor, float incidentIor ) {
		return pow2( ( transmittedIor - incidentIor ) / ( transmittedIor + incidentIor ));
	}
	vec3 evalSensitivity( float OPD, vec3 shift ) {
		float phase = 2.0 * PI * OPD * 1.0e-9;
		vec3 val = vec3( 5.4856e-13, 4.4201e-13, 5.2481e-13 );
		vec3 pos = vec3( 1.6810e+06, 1.7953e+06, 2.2084e+06 );
		vec3 var = vec3( 4.3278e+09, 9.3046e+09, 6.6121e+09 );
		vec3 xyz = val * sqrt( 2.0 * PI * var ) * cos( pos * phase + shift ) * exp( - pow2( phase ) * var );
		xyz.x += 9.7470e-14 * sqrt( 2.0 * PI * 4.5282e+09 ) * cos( 2.2399e+06 * phase + shift[ 0 ] ) * exp( - 4.5282e+09 * pow2( phase ) );
		xyz /= 1.0685e-7;
		vec3 rgb = XYZ_TO_REC709 * xyz;
		return rgb;
	}
	vec3 evalIridescence( float outsideIOR, float eta2, float cosTheta1, float thinFilmThickness, vec3 baseF0 ) {
		vec3 I;
		float iridescenceIOR = mix( outsideIOR, eta2, smoothstep( 0.0, 0.03, thinFilmThickness ) );
		float sinTheta2Sq = pow2( outsideIOR / iridescenceIOR ) * ( 1.0 - pow2( cosTheta1 ) );
		float cosTheta2Sq = 1.0 - sinTheta2Sq;
		if ( cosTheta2Sq < 0.0 ) {
			return vec3( 1.0 );
		}
		float cosTheta2 = sqrt( cosTheta2Sq );
		float R0 = IorToFresnel0( iridescenceIOR, outsideIOR );
		float R12 = F_Schlick( R0, 1.0, cosTheta1 );
		float T121 = 1.0 - R12;
		float phi12 = 0.0;
		if ( iridescenceIOR < outsideIOR ) phi12 = PI;
		float phi21 = PI - phi12;
		vec3 baseIOR = Fresnel0ToIor( clamp( baseF0, 0.0, 0.9999 ) );		vec3 R1 = IorToFresnel0( baseIOR, iridescenceIOR );
		vec3 R23 = F_Schlick( R1, 1.0, cosTheta2 );
		vec3 phi23 = vec3( 0.0 );
		if ( baseIOR[ 0 ] < iridescenceIOR ) phi23[ 0 ] = PI;
		if ( baseIOR[ 1 ] < iridescenceIOR ) phi23[ 1 ] = PI;
		if ( baseIOR[ 2 ] < iridescenceIOR ) phi23[ 2 ] = PI;
		float OPD = 2.0 * iridescenceIOR * thinFilmThickness * cosTheta2;
		vec3 phi = vec3( phi21 ) + phi23;
		vec3 R123 = clamp( R12 * R23, 1e-5, 0.9999 );
		vec3 r123 = sqrt( R123 );
		vec3 Rs = pow2( T121 ) * R23 / ( vec3( 1.0 ) - R123 );
		vec3 C0 = R12 + Rs;
		I = C0;
		vec3 Cm = Rs - T121;
		for ( int m = 1; m <= 2; ++ m ) {
			Cm *= r123;
			vec3 Sm = 2.0 * evalSensitivity( float( m ) * OPD, float( m ) * phi );
			I += Cm * Sm;
		}
		return max( I, vec3( 0.0 ) );
	}
#endif`,gM=`#ifdef USE_BUMPMAP
	uniform sampler2D bumpMap;
	uniform float bumpScale;
	vec2 dHdxy_fwd() {
		vec2 dSTdx = dFdx( vBumpMapUv );
		vec2 dSTdy = dFdy( vBumpMapUv );
		float Hll = bumpScale * texture2D( bumpMap, vBumpMapUv ).x;
		float dBx = bumpScale * texture2D( bumpMap, vBumpMapUv + dSTdx ).x - Hll;
		float dBy = bumpScale * texture2D( bumpMap, vBumpMapUv + dSTdy ).x - Hll;
		return vec2( dBx, dBy );
	}
	vec3 perturbNormalArb( vec3 surf_pos, vec3 surf_norm, vec2 dHdxy, float faceDirection ) {
		vec3 vSigmaX = normalize( dFdx( surf_pos.xyz ) );
		vec3 vSigmaY = normalize( dFdy( surf_pos.xyz ) );
		vec3 vN = surf_norm;
		vec3 R1 = cross( vSigmaY, vN );
		vec3 R2 = cross( vN, vSigmaX );
		float fDet = dot( vSigmaX, R1 ) * faceDirection;
		vec3 vGrad = sign( fDet ) * ( dHdxy.x * R1 + dHdxy.y * R2 );
		return normalize( abs( fDet ) * surf_norm - vGrad );
	}
#endif`,_M=`#if NUM_CLIPPING_PLANES > 0
	vec4 plane;
	#ifdef ALPHA_TO_COVERAGE
		float distanceToPlane, distanceGradient;
		float clipOpacity = 1.0;
		#pragma unroll_loop_start
		for ( int i = 0; i < UNION_CLIPPING_PLANES; i ++ ) {
			plane = clippingPlanes[ i ];
			distanceToPlane = - dot( vClipPosition, plane.xyz ) + plane.w;
			distanceGradient = fwidth( distanceToPlane ) / 2.0;
			clipOpacity *= smoothstep( - distanceGradient, distanceGradient, distanceToPlane );
			if ( clipOpacity == 0.0 ) discard;
		}
		#pragma unroll_loop_end
		#if UNION_CLIPPING_PLANES < NUM_CLIPPING_PLANES
			float unionClipOpacity = 1.0;
			#pragma unroll_loop_start
			for ( int i = UNION_CLIPPING_PLANES; i < NUM_CLIPPING_PLANES; i ++ ) {
				plane = clippingPlanes[ i ];
				distanceToPlane = - dot( vClipPosition, plane.xyz ) + plane.w;
				distanceGradient = fwidth( distanceToPlane ) / 2.0;
				unionClipOpacity *= 1.0 - smoothstep( - distanceGradient, distanceGradient, distanceToPlane );
			}
			#pragma unroll_loop_end
			clipOpacity *= 1.0 - unionClipOpacity;
		#endif
		diffuseColor.a *= clipOpacity;
		if ( diffuseColor.a == 0.0 ) discard;
	#else
		#pragma unroll_loop_start
		for ( int i = 0; i < UNION_CLIPPING_PLANES; i ++ ) {
			plane = clippingPlanes[ i ];
			if ( dot( vClipPosition, plane.xyz ) > plane.w ) discard;
		}
		#pragma unroll_loop_end
		#if UNION_CLIPPING_PLANES < NUM_CLIPPING_PLANES
			bool clipped = true;
			#pragma unroll_loop_start
			for ( int i = UNION_CLIPPING_PLANES; i < NUM_CLIPPING_PLANES; i ++ ) {
				plane = clippingPlanes[ i ];
				clipped = ( dot( vClipPosition, plane.xyz ) > plane.w ) && clipped;
			}
			#pragma unroll_loop_end
			if ( clipped ) discard;
		#endif
	#endif
#endif`,xM=`#if NUM_CLIPPING_PLANES > 0
	varying vec3 vClipPosition;
	uniform vec4 clippingPlanes[ NUM_CLIPPING_PLANES ];
#endif`,yM=`#if NUM_CLIPPING_PLANES > 0
	varying vec3 vClipPosition;
#endif`,vM=`#if NUM_CLIPPING_PLANES > 0
	vClipPosition = - mvPosition.xyz;
#endif`,bM=`#if defined( USE_COLOR ) || defined( USE_COLOR_ALPHA )
	diffuseColor *= vColor;
#endif`,MM=`#if defined( USE_COLOR ) || defined( USE_COLOR_ALPHA )
	varying vec4 vColor;
#endif`,SM=`#if defined( USE_COLOR ) || defined( USE_COLOR_ALPHA ) || defined( USE_INSTANCING_COLOR ) || defined( USE_BATCHING_COLOR )
	varying vec4 vColor;
#endif`,wM=`#if defined( USE_COLOR ) || defined( USE_COLOR_ALPHA ) || defined( USE_INSTANCING_COLOR ) || defined( USE_BATCHING_COLOR )
	vColor = vec4( 1.0 );
#endif
#ifdef USE_COLOR_ALPHA
	vColor *= color;
#elif defined( USE_COLOR )
	vColor.rgb *= color;
#endif
#ifdef USE_INSTANCING_COLOR
	vColor.rgb *= instanceColor.rgb;
#endif
#ifdef USE_BATCHING_COLOR
	vColor *= getBatchingColor( getIndirectIndex( gl_DrawID ) );
#endif`,AM=`#define PI 3.141592653589793
#define PI2 6.283185307179586
#define PI_HALF 1.5707963267948966
#define RECIPROCAL_PI 0.3183098861837907
#define RECIPROCAL_PI2 0.15915494309189535
#define EPSILON 1e-6
#ifndef saturate
#define saturate( a ) clamp( a, 0.0, 1.0 )
#endif
#define whiteComplement( a ) ( 1.0 - saturate( a ) )
float pow2( const in float x ) { return x*x; }
vec3 pow2( const in vec3 x ) { return x*x; }
float pow3( const in float x ) { return x*x*x; }
float pow4( const in float x ) { float x2 = x*x; return x2*x2; }
float max3( const in vec3 v ) { return max( max( v.x, v.y ), v.z ); }
float average( const in vec3 v ) { return dot( v, vec3( 0.3333333 ) ); }
highp float rand( const in vec2 uv ) {
	const highp float a = 12.9898, b = 78.233, c = 43758.5453;
	highp float dt = dot( uv.xy, vec2( a,b ) ), sn = mod( dt, PI );
	return fract( sin( sn ) * c );
}
#ifdef HIGH_PRECISION
	float precisionSafeLength( vec3 v ) { return length( v ); }
#else
	float precisionSafeLength( vec3 v ) {
		float maxComponent = max3( abs( v ) );
		return length( v / maxComponent ) * maxComponent;
	}
#endif
struct IncidentLight {
	vec3 color;
	vec3 direction;
	bool visible;
};
struct ReflectedLight {
	vec3 directDiffuse;
	vec3 directSpecular;
	vec3 indirectDiffuse;
	vec3 indirectSpecular;
};
#ifdef USE_ALPHAHASH
	varying vec3 vPosition;
#endif
vec3 transformDirection( in vec3 dir, in mat4 matrix ) {
	return normalize( ( matrix * vec4( dir, 0.0 ) ).xyz );
}
#define inverseTransformDirection transformDirectionByInverseViewMatrix
vec3 transformNormalByInverseViewMatrix( in vec3 normal, in mat4 viewMatrix ) {
	return normalize( ( vec4( normal, 0.0 ) * viewMatrix ).xyz );
}
vec3 transformDirectionByInverseViewMatrix( in vec3 dir, in mat4 viewMatrix ) {
	return normalize( ( vec4( dir, 0.0 ) * viewMatrix ).xyz );
}
bool isPerspectiveMatrix( mat4 m ) {
	return m[ 2 ][ 3 ] == - 1.0;
}
vec2 equirectUv( in vec3 dir ) {
	float u = atan( dir.z, dir.x ) * RECIPROCAL_PI2 + 0.5;
	float v = asin( clamp( dir.y, - 1.0, 1.0 ) ) * RECIPROCAL_PI + 0.5;
	return vec2( u, v );
}
vec3 BRDF_Lambert( const in vec3 diffuseColor ) {
	return RECIPROCAL_PI * diffuseColor;
}
vec3 F_Schlick( const in vec3 f0, const in float f90, const in float dotVH ) {
	float fresnel = exp2( ( - 5.55473 * dotVH - 6.98316 ) * dotVH );
	return f0 * ( 1.0 - fresnel ) + ( f90 * fresnel );
}
float F_Schlick( const in float f0, const in float f90, const in float dotVH ) {
	float fresnel = exp2( ( - 5.55473 * dotVH - 6.98316 ) * dotVH );
	return f0 * ( 1.0 - fresnel ) + ( f90 * fresnel );
} // validated`,EM=`vec3 transformedNormal = objectNormal;
#ifdef USE_TANGENT
	vec3 transformedTangent = objectTangent;
#endif
#ifdef USE_BATCHING
	mat3 bm = mat3( batchingMatrix );
	transformedNormal /= vec3( dot( bm[ 0 ], bm[ 0 ] ), dot( bm[ 1 ], bm[ 1 ] ), dot( bm[ 2 ], bm[ 2 ] ) );
	transformedNormal = bm * transformedNormal;
	#ifdef USE_TANGENT
		transformedTangent = bm * transformedTangent;
	#endif
#endif
#ifdef USE_INSTANCING
	mat3 im = mat3( instanceMatrix );
	transformedNormal /= vec3( dot( im[ 0 ], im[ 0 ] ), dot( im[ 1 ], im[ 1 ] ), dot( im[ 2 ], im[ 2 ] ) );
	transformedNormal = im * transformedNormal;
	#ifdef USE_TANGENT
		transformedTangent = im * transformedTangent;
	#endif
#endif
transformedNormal = normalMatrix * transformedNormal;
#ifdef FLIP_SIDED
	transformedNormal = - transformedNormal;
#endif
#ifdef USE_TANGENT
	transformedTangent = ( modelViewMatrix * vec4( transformedTangent, 0.0 ) ).xyz;
#endif`,TM=`#ifdef USE_DISPLACEMENTMAP
	uniform sampler2D displacementMap;
	uniform float displacementScale;
	uniform float displacementBias;
#endif`,CM=`#ifdef USE_DISPLACEMENTMAP
	transformed += normalize( objectNormal ) * ( texture2D( displacementMap, vDisplacementMapUv ).x * displacementScale + displacementBias );
#endif`,RM=`#ifdef USE_EMISSIVEMAP
	vec4 emissiveColor = texture2D( emissiveMap, vEmissiveMapUv );
	#ifdef DECODE_VIDEO_TEXTURE_EMISSIVE
		emissiveColor = sRGBTransferEOTF( emissiveColor );
	#endif
	totalEmissiveRadiance *= emissiveColor.rgb;
#endif`,PM=`#ifdef USE_EMISSIVEMAP
	uniform sampler2D emissiveMap;
#endif`,IM="gl_FragColor = linearToOutputTexel( gl_FragColor );",LM=`vec4 LinearTransferOETF( in vec4 value ) {
	return value;
}
vec4 sRGBTransferEOTF( in vec4 value ) {
	return vec4( mix( pow( value.rgb * 0.9478672986 + vec3( 0.0521327014 ), vec3( 2.4 ) ), value.rgb * 0.0773993808, vec3( lessThanEqual( value.rgb, vec3( 0.04045 ) ) ) ), value.a );
}
vec4 sRGBTransferOETF( in vec4 value ) {
	return vec4( mix( pow( value.rgb, vec3( 0.41666 ) ) * 1.055 - vec3( 0.055 ), value.rgb * 12.92, vec3( lessThanEqual( value.rgb, vec3( 0.0031308 ) ) ) ), value.a );
}`,NM=`#ifdef USE_ENVMAP
	#ifdef ENV_WORLDPOS
		vec3 cameraToFrag;
		if ( isOrthographic ) {
			cameraToFrag = normalize( vec3( - viewMatrix[ 0 ][ 2 ], - viewMatrix[ 1 ][ 2 ], - viewMatrix[ 2 ][ 2 ] ) );
		} else {
			cameraToFrag = normalize( vWorldPosition - cameraPosition );
		}
		vec3 worldNormal = transformNormalByInverseViewMatrix( normal, viewMatrix );
		#ifdef ENVMAP_MODE_REFLECTION
			vec3 reflectVec = reflect( cameraToFrag, worldNormal );
		#else
			vec3 reflectVec = refract( cameraToFrag, worldNormal, refractionRatio );
		#endif
	#else
		vec3 reflectVec = vReflect;
	#endif
	#ifdef ENVMAP_TYPE_CUBE
		vec4 envColor = textureCube( envMap, envMapRotation * reflectVec );
		#ifdef ENVMAP_BLENDING_MULTIPLY
			outgoingLight = mix( outgoingLight, outgoingLight * envColor.xyz, specularStrength * reflectivity );
		#elif defined( ENVMAP_BLENDING_MIX )
			outgoingLight = mix( outgoingLight, envColor.xyz, specularStrength * reflectivity );
		#elif defined( ENVMAP_BLENDING_ADD )
			outgoingLight += envColor.xyz * specularStrength * reflectivity;
		#endif
	#endif
#endif`,DM=`#ifdef USE_ENVMAP
	uniform float envMapIntensity;
	uniform mat3 envMapRotation;
	uniform samplerCube envMap;
	#ifdef ENVMAP_TYPE_PMREM
		float roughnessToMip( const in float roughness ) {
			float r = clamp( roughness, 0.0, 1.0 );
			return ENVMAP_MAX_LOD * r * ( 2.0 - r );
		}
	#endif
#endif`,UM=`#ifdef USE_ENVMAP
	uniform float reflectivity;
	#if defined( USE_BUMPMAP ) || defined( USE_NORMALMAP ) || defined( PHONG ) || defined( LAMBERT )
		#define ENV_WORLDPOS
	#endif
	#ifdef ENV_WORLDPOS
		varying vec3 vWorldPosition;
		uniform float refractionRatio;
	#else
		varying vec3 vReflect;
	#endif
#endif`,OM=`#ifdef USE_ENVMAP
	#if defined( USE_BUMPMAP ) || defined( USE_NORMALMAP ) || defined( PHONG ) || defined( LAMBERT )
		#define ENV_WORLDPOS
	#endif
	#ifdef ENV_WORLDPOS
		
		varying vec3 vWorldPosition;
	#else
		varying vec3 vReflect;
		uniform float refractionRatio;
	#endif
#endif`,FM=`#ifdef USE_ENVMAP
	#ifdef ENV_WORLDPOS
		vWorldPosition = worldPosition.xyz;
	#else
		vec3 cameraToVertex;
		if ( isOrthographic ) {
			cameraToVertex = normalize( vec3( - viewMatrix[ 0 ][ 2 ], - viewMatrix[ 1 ][ 2 ], - viewMatrix[ 2 ][ 2 ] ) );
		} else {
			cameraToVertex = normalize( worldPosition.xyz - cameraPosition );
		}
		vec3 worldNormal = transformNormalByInverseViewMatrix( transformedNormal, viewMatrix );
		#ifdef ENVMAP_MODE_REFLECTION
			vReflect = reflect( cameraToVertex, worldNormal );
		#else
			vReflect = refract( cameraToVertex, worldNormal, refractionRatio );
		#endif
	#endif
#endif`,BM=`#ifdef USE_FOG
	vFogDepth = - mvPosition.z;
#endif`,kM=`#ifdef USE_FOG
	varying float vFogDepth;
#endif`,zM=`#ifdef USE_FOG
	#ifdef FOG_EXP2
		float fogFactor = 1.0 - exp( - fogDensity * fogDensity * vFogDepth * vFogDepth );
	#else
		float fogFactor = smoothstep( fogNear, fogFar, vFogDepth );
	#endif
	gl_FragColor.rgb = mix( gl_FragColor.rgb, fogColor, fogFactor );
#endif`,VM=`#ifdef USE_FOG
	uniform vec3 fogColor;
	varying float vFogDepth;
	#ifdef FOG_EXP2
		uniform float fogDensity;
	#else
		uniform float fogNear;
		uniform float fogFar;
	#endif
#endif`,GM=`#ifdef USE_GRADIENTMAP
	uniform sampler2D gradientMap;
#endif
vec3 getGradientIrradiance( vec3 normal, vec3 lightDirection ) {
	float dotNL = dot( normal, lightDirection );
	vec2 coord = vec2( dotNL * 0.5 + 0.5, 0.0 );
	#ifdef USE_GRADIENTMAP
		return vec3( texture2D( gradientMap, coord ).r );
	#else
		vec2 fw = fwidth( coord ) * 0.5;
		return mix( vec3( 0.7 ), vec3( 1.0 ), smoothstep( 0.7 - fw.x, 0.7 + fw.x, coord.x ) );
	#endif
}`,HM=`#ifdef USE_LIGHTMAP
	uniform sampler2D lightMap;
	uniform float lightMapIntensity;
#endif`,WM=`LambertMaterial material;
material.diffuseColor = diffuseColor.rgb;
material.specularStrength = specularStrength;`,XM=`varying vec3 vViewPosition;
struct LambertMaterial {
	vec3 diffuseColor;
	float specularStrength;
};
void RE_Direct_Lambert( const in IncidentLight directLight, const in vec3 geometryPosition, const in vec3 geometryNormal, const in vec3 geometryViewDir, const in vec3 geometryClearcoatNormal, const in LambertMaterial material, inout ReflectedLight reflectedLight ) {
	float dotNL = saturate( dot( geometryNormal, directLight.direction ) );
	vec3 irradiance = dotNL * directLight.color;
	reflectedLight.directDiffuse += irradiance * BRDF_Lambert( material.diffuseColor );
}
void RE_IndirectDiffuse_Lambert( const in vec3 irradiance, const in vec3 geometryPosition, const in vec3 geometryNormal, const in vec3 geometryViewDir, const in vec3 geometryClearcoatNormal, const in LambertMaterial material, inout ReflectedLight reflectedLight ) {
	reflectedLight.indirectDiffuse += irradiance * BRDF_Lambert( material.diffuseColor );
}
#define RE_Direct				RE_Direct_Lambert
#define RE_IndirectDiffuse		RE_IndirectDiffuse_Lambert`,$M=`uniform bool receiveShadow;
uniform vec3 ambientLightColor;
#if defined( USE_LIGHT_PROBES )
	uniform vec3 lightProbe[ 9 ];
#endif
vec3 shGetIrradianceAt( in vec3 normal, in vec3 shCoefficients[ 9 ] ) {
	float x = normal.x, y = normal.y, z = normal.z;
	vec3 result = shCoefficients[ 0 ] * 0.886227;
	result += shCoefficients[ 1 ] * 2.0 * 0.511664 * y;
	result += shCoefficients[ 2 ] * 2.0 * 0.511664 * z;
	result += shCoefficients[ 3 ] * 2.0 * 0.511664 * x;
	result += shCoefficients[ 4 ] * 2.0 * 0.429043 * x * y;
	result += shCoefficients[ 5 ] * 2.0 * 0.429043 * y * z;
	result += shCoefficients[ 6 ] * ( 0.743125 * z * z - 0.247708 );
	result += shCoefficients[ 7 ] * 2.0 * 0.429043 * x * z;
	result += shCoefficients[ 8 ] * 0.429043 * ( x * x - y * y );
	return result;
}
vec3 getLightProbeIrradiance( const in vec3 lightProbe[ 9 ], const in vec3 normal ) {
	vec3 worldNormal = transformNormalByInverseViewMatrix( normal, viewMatrix );
	vec3 irradiance = shGetIrradianceAt( worldNormal, lightProbe );
	return irradiance;
}
vec3 getAmbientLightIrradiance( const in vec3 ambientLightColor ) {
	vec3 irradiance = ambientLightColor;
	return irradiance;
}
float getDistanceAttenuation( const in float lightDistance, const in float cutoffDistance, const in float decayExponent ) {
	float distanceFalloff = 1.0 / max( pow( lightDistance, decayExponent ), 0.01 );
	if ( cutoffDistance > 0.0 ) {
		distanceFalloff *= pow2( saturate( 1.0 - pow4( lightDistance / cutoffDistance ) ) );
	}
	return distanceFalloff;
}
float getSpotAttenuation( const in float coneCosine, const in float penumbraCosine, const in float angleCosine ) {
	return smoothstep( coneCosine, penumbraCosine, angleCosine );
}
#if NUM_SUN_LIGHTS > 0
	struct SunLight {
		vec3 direction;
		vec3 color;
	};
	uniform SunLight sunLights[ NUM_SUN_LIGHTS ];
	void getSunLightInfo( const in SunLight sunLight, out IncidentLight light ) {
		light.color = sunLight.color;
		light.direction = sunLight.direction;
		light.visible = true;
	}
#endif
#if NUM_DIR_LIGHTS > 0
	struct DirectionalLight {
		vec3 direction;
		vec3 color;
	};
	uniform DirectionalLight directionalLights[ NUM_DIR_LIGHTS ];
	void getDirectionalLightInfo( const in DirectionalLight directionalLight, out IncidentLight light ) {
		light.color = directionalLight.color;
		light.direction = directionalLight.direction;
		light.visible = true;
	}
#endif
#if NUM_POINT_LIGHTS > 0
	struct PointLight {
		vec3 position;
		vec3 color;
		float distance;
		float decay;
	};
	uniform PointLight pointLights[ NUM_POINT_LIGHTS ];
	void getPointLightInfo( const in PointLight pointLight, const in vec3 geometryPosition, out IncidentLight light ) {
		vec3 lVector = pointLight.position - geometryPosition;
		light.direction = normalize( lVector );
		float lightDistance = length( lVector );
		light.color = pointLight.color;
		light.color *= getDistanceAttenuation( lightDistance, pointLight.distance, pointLight.decay );
		light.visible = ( light.color != vec3( 0.0 ) );
	}
#endif
#if NUM_SPOT_LIGHTS > 0
	struct SpotLight {
		vec3 position;
		vec3 direction;
		vec3 color;
		float distance;
		float decay;
		float coneCos;
		float penumbraCos;
	};
	uniform SpotLight spotLights[ NUM_SPOT_LIGHTS ];
	void getSpotLightInfo( const in SpotLight spotLight, const in vec3 geometryPosition, out IncidentLight light ) {
		vec3 lVector = spotLight.position - geometryPosition;
		light.direction = normalize( lVector );
		float angleCos = dot( light.direction, spotLight.direction );
		float spotAttenuation = getSpotAttenuation( spotLight.coneCos, spotLight.penumbraCos, angleCos );
		if ( spotAttenuation > 0.0 ) {
			float lightDistance = length( lVector );
			light.color = spotLight.color * spotAttenuation;
			light.color *= getDistanceAttenuation( lightDistance, spotLight.distance, spotLight.decay );
			light.visible = ( light.color != vec3( 0.0 ) );
		} else {
			light.color = vec3( 0.0 );
			light.visible = false;
		}
	}
#endif
#if NUM_RECT_AREA_LIGHTS > 0
	struct RectAreaLight {
		vec3 color;
		vec3 position;
		vec3 halfWidth;
		vec3 halfHeight;
	};
	uniform sampler2D ltc_1;	uniform sampler2D ltc_2;
	uniform RectAreaLight rectAreaLights[ NUM_RECT_AREA_LIGHTS ];
#endif
#if NUM_HEMI_LIGHTS > 0
	struct HemisphereLight {
		vec3 direction;
		vec3 skyColor;
		vec3 groundColor;
	};
	uniform HemisphereLight hemisphereLights[ NUM_HEMI_LIGHTS ];
	vec3 getHemisphereLightIrradiance( const in HemisphereLight hemiLight, const in vec3 normal ) {
		float dotNL = dot( normal, hemiLight.direction );
		float hemiDiffuseWeight = 0.5 * dotNL + 0.5;
		vec3 irradiance = mix( hemiLight.groundColor, hemiLight.skyColor, hemiDiffuseWeight );
		return irradiance;
	}
#endif
#include <lightprobes_pars_fragment>`,qM=`#ifdef USE_ENVMAP
	vec3 getIBLIrradiance( const in vec3 normal ) {
		#ifdef ENVMAP_TYPE_PMREM
			vec3 worldNormal = transformNormalByInverseViewMatrix( normal, viewMatrix );
			vec4 envMapColor = textureLod( envMap, envMapRotation * worldNormal, ENVMAP_MAX_LOD );
			return PI * envMapColor.rgb * envMapIntensity;
		#else
			return vec3( 0.0 );
		#endif
	}
	vec3 getIBLRadiance( const in vec3 viewDir, const in vec3 normal, const in float roughness ) {
		#ifdef ENVMAP_TYPE_PMREM
			vec3 reflectVec = reflect( - viewDir, normal );
			reflectVec = normalize( mix( reflectVec, normal, pow4( roughness ) ) );
			reflectVec = transformDirectionByInverseViewMatrix( reflectVec, viewMatrix );
			vec4 envMapColor = textureLod( envMap, envMapRotation * reflectVec, roughnessToMip( roughness ) );
			return envMapColor.rgb * envMapIntensity;
		#else
			return vec3( 0.0 );
		#endif
	}
	#ifdef USE_RETROREFLECTION
		vec3 getIBLRetroRadiance( const in vec3 viewDir, const in vec3 normal, const in float roughness ) {
			#ifdef ENVMAP_TYPE_PMREM
				vec3 retroVec = normalize( mix( viewDir, normal, pow4( roughness ) ) );
				retroVec = transformDirectionByInverseViewMatrix( retroVec, viewMatrix );
				vec4 envMapColor = textureLod( envMap, envMapRotation * retroVec, roughnessToMip( roughness ) );
				return envMapColor.rgb * envMapIntensity;
			#else
				return vec3( 0.0 );
			#endif
		}
	#endif
	#ifdef USE_ANISOTROPY
		vec3 getIBLAnisotropyRadiance( const in vec3 viewDir, const in vec3 normal, const in float roughness, const in vec3 bitangent, const in float anisotropy ) {
			#ifdef ENVMAP_TYPE_PMREM
				vec3 bentNormal = cross( bitangent, viewDir );
				bentNormal = normalize( cross( bentNormal, bitangent ) );
				bentNormal = normalize( mix( bentNormal, normal, pow2( pow2( 1.0 - anisotropy * ( 1.0 - roughness ) ) ) ) );
				return getIBLRadiance( viewDir, bentNormal, roughness );
			#else
				return vec3( 0.0 );
			#endif
		}
		#ifdef USE_RETROREFLECTION
			vec3 getIBLAnisotropyRetroRadiance( const in vec3 viewDir, const in vec3 normal, const in float roughness, const in vec3 bitangent, const in float anisotropy ) {
				#ifdef ENVMAP_TYPE_PMREM
					vec3 bentNormal = cross( bitangent, viewDir );
					bentNormal = normalize( cross( bentNormal, bitangent ) );
					bentNormal = normalize( mix( bentNormal, normal, pow2( pow2( 1.0 - anisotropy * ( 1.0 - roughness ) ) ) ) );
					return getIBLRetroRadiance( viewDir, bentNormal, roughness );
				#else
					return vec3( 0.0 );
				#endif
			}
		#endif
	#endif
#endif`,YM=`ToonMaterial material;
material.diffuseColor = diffuseColor.rgb;`,ZM=`varying vec3 vViewPosition;
struct ToonMaterial {
	vec3 diffuseColor;
};
void RE_Direct_Toon( const in IncidentLight directLight, const in vec3 geometryPosition, const in vec3 geometryNormal, const in vec3 geometryViewDir, const in vec3 geometryClearcoatNormal, const in ToonMaterial material, inout ReflectedLight reflectedLight ) {
	vec3 irradiance = getGradientIrradiance( geometryNormal, directLight.direction ) * directLight.color;
	reflectedLight.directDiffuse += irradiance * BRDF_Lambert( material.diffuseColor );
}
void RE_IndirectDiffuse_Toon( const in vec3 irradiance, const in vec3 geometryPosition, const in vec3 geometryNormal, const in vec3 geometryViewDir, const in vec3 geometryClearcoatNormal, const in ToonMaterial material, inout ReflectedLight reflectedLight ) {
	reflectedLight.indirectDiffuse += irradiance * BRDF_Lambert( material.diffuseColor );
}
#define RE_Direct				RE_Direct_Toon
#define RE_IndirectDiffuse		RE_IndirectDiffuse_Toon`,JM=`BlinnPhongMaterial material;
material.diffuseColor = diffuseColor.rgb;
material.specularColor = specular;
material.specularShininess = shininess;
material.specularStrength = specularStrength;`,jM=`varying vec3 vViewPosition;
struct BlinnPhongMaterial {
	vec3 diffuseColor;
	vec3 specularColor;
	float specularShininess;
	float specularStrength;
};
void RE_Direct_BlinnPhong( const in IncidentLight directLight, const in vec3 geometryPosition, const in vec3 geometryNormal, const in vec3 geometryViewDir, const in vec3 geometryClearcoatNormal, const in BlinnPhongMaterial material, inout ReflectedLight reflectedLight ) {
	float dotNL = saturate( dot( geometryNormal, directLight.direction ) );
	vec3 irradiance = dotNL * directLight.color;
	reflectedLight.directDiffuse += irradiance * BRDF_Lambert( material.diffuseColor );
	reflectedLight.directSpecular += irradiance * BRDF_BlinnPhong( directLight.direction, geometryViewDir, geometryNormal, material.specularColor, material.specularShininess ) * material.specularStrength;
}
void RE_IndirectDiffuse_BlinnPhong( const in vec3 irradiance, const in vec3 geometryPosition, const in vec3 geometryNormal, const in vec3 geometryViewDir, const in vec3 geometryClearcoatNormal, const in BlinnPhongMaterial material, inout ReflectedLight reflectedLight ) {
	reflectedLight.indirectDiffuse += irradiance * BRDF_Lambert( material.diffuseColor );
}
#define RE_Direct				RE_Direct_BlinnPhong
#define RE_IndirectDiffuse		RE_IndirectDiffuse_BlinnPhong`,KM=`PhysicalMaterial material;
material.diffuseColor = diffuseColor.rgb;
material.diffuseContribution = diffuseColor.rgb * ( 1.0 - metalnessFactor );
material.metalness = metalnessFactor;
vec3 dxy = max( abs( dFdx( nonPerturbedNormal ) ), abs( dFdy( nonPerturbedNormal ) ) );
float geometryRoughness = max( max( dxy.x, dxy.y ), dxy.z );
material.roughness = max( roughnessFactor, 0.045 );
material.roughness += geometryRoughness;
material.roughness = min( material.roughness, 1.0 );
#ifdef USE_DIFFUSE_ROUGHNESS
	float diffuseRoughnessFactor = diffuseRoughness;
	#ifdef USE_DIFFUSE_ROUGHNESSMAP
		diffuseRoughnessFactor *= texture2D( diffuseRoughnessMap, vDiffuseRoughnessMapUv ).r;
	#endif
	material.diffuseRoughness = saturate( diffuseRoughnessFactor );
#endif
#ifdef IOR
	material.ior = ior;
	#ifdef USE_SPECULAR
		float specularIntensityFactor = specularIntensity;
		vec3 specularColorFactor = specularColor;
		#ifdef USE_SPECULAR_COLORMAP
			specularColorFactor *= texture2D( specularColorMap, vSpecularColorMapUv ).rgb;
		#endif
		#ifdef USE_SPECULAR_INTENSITYMAP
			specularIntensityFactor *= texture2D( specularIntensityMap, vSpecularIntensityMapUv ).a;
		#endif
		material.specularF90 = mix( specularIntensityFactor, 1.0, metalnessFactor );
	#else
		float specularIntensityFactor = 1.0;
		vec3 specularColorFactor = vec3( 1.0 );
		material.specularF90 = 1.0;
	#endif
	material.specularColor = min( pow2( ( material.ior - 1.0 ) / ( material.ior + 1.0 ) ) * specularColorFactor, vec3( 1.0 ) ) * specularIntensityFactor;
	material.specularColorBlended = mix( material.specularColor, diffuseColor.rgb, metalnessFactor );
#else
	material.specularColor = vec3( 0.04 );
	material.specularColorBlended = mix( material.specularColor, diffuseColor.rgb, metalnessFactor );
	material.specularF90 = 1.0;
#endif
#ifdef USE_CLEARCOAT
	material.clearcoat = clearcoat;
	material.clearcoatRoughness = clearcoatRoughness;
	material.clearcoatF0 = vec3( 0.04 );
	material.clearcoatF90 = 1.0;
	#ifdef USE_CLEARCOATMAP
		material.clearcoat *= texture2D( clearcoatMap, vClearcoatMapUv ).x;
	#endif
	#ifdef USE_CLEARCOAT_ROUGHNESSMAP
		material.clearcoatRoughness *= texture2D( clearcoatRoughnessMap, vClearcoatRoughnessMapUv ).y;
	#endif
	material.clearcoat = saturate( material.clearcoat );	material.clearcoatRoughness = max( material.clearcoatRoughness, 0.045 );
	material.clearcoatRoughness += geometryRoughness;
	material.clearcoatRoughness = min( material.clearcoatRoughness, 1.0 );
#endif
#ifdef USE_DISPERSION
	material.dispersion = dispersion;
#endif
#ifdef USE_RETROREFLECTION
	material.retroreflectivity = retroreflectivity;
#endif
#ifdef USE_IRIDESCENCE
	material.iridescence = iridescence;
	material.iridescenceIOR = iridescenceIOR;
	#ifdef USE_IRIDESCENCEMAP
		material.iridescence *= texture2D( iridescenceMap, vIridescenceMapUv ).r;
	#endif
	#ifdef USE_IRIDESCENCE_THICKNESSMAP
		material.iridescenceThickness = (iridescenceThicknessMaximum - iridescenceThicknessMinimum) * texture2D( iridescenceThicknessMap, vIridescenceThicknessMapUv ).g + iridescenceThicknessMinimum;
	#else
		material.iridescenceThickness = iridescenceThicknessMaximum;
	#endif
#endif
#ifdef USE_SHEEN
	material.sheenColor = sheenColor;
	#ifdef USE_SHEEN_COLORMAP
		material.sheenColor *= texture2D( sheenColorMap, vSheenColorMapUv ).rgb;
	#endif
	material.sheenRoughness = clamp( sheenRoughness, 0.0001, 1.0 );
	#ifdef USE_SHEEN_ROUGHNESSMAP
		material.sheenRoughness *= texture2D( sheenRoughnessMap, vSheenRoughnessMapUv ).a;
	#endif
#endif
#ifdef USE_ANISOTROPY
	#ifdef USE_ANISOTROPYMAP
		mat2 anisotropyMat = mat2( anisotropyVector.x, anisotropyVector.y, - anisotropyVector.y, anisotropyVector.x );
		vec3 anisotropyPolar = texture2D( anisotropyMap, vAnisotropyMapUv ).rgb;
		vec2 anisotropyV = anisotropyMat * normalize( 2.0 * anisotropyPolar.rg - vec2( 1.0 ) ) * anisotropyPolar.b;
	#else
		vec2 anisotropyV = anisotropyVector;
	#endif
	material.anisotropy = length( anisotropyV );
	if( material.anisotropy == 0.0 ) {
		anisotropyV = vec2( 1.0, 0.0 );
	} else {
		anisotropyV /= material.anisotropy;
		material.anisotropy = saturate( material.anisotropy );
	}
	material.alphaT = mix( pow2( material.roughness ), 1.0, pow2( material.anisotropy ) );
	material.anisotropyT = tbn[ 0 ] * anisotropyV.x + tbn[ 1 ] * anisotropyV.y;
	material.anisotropyB = tbn[ 1 ] * anisotropyV.x - tbn[ 0 ] * anisotropyV.y;
#endif`,QM=`uniform sampler2D dfgLUT;
struct PhysicalMaterial {
	vec3 diffuseColor;
	vec3 diffuseContribution;
	vec3 specularColor;
	vec3 specularColorBlended;
	float roughness;
	float metalness;
	float specularF90;
	float dispersion;
	vec2 dfg;
	vec3 multiScatteringCompensation;
	#ifdef USE_DIFFUSE_ROUGHNESS
		float diffuseRoughness;
	#endif
	#ifdef USE_RETROREFLECTION
		float retroreflectivity;
	#endif
	#ifdef USE_CLEARCOAT
		float clearcoat;
		float clearcoatRoughness;
		vec3 clearcoatF0;
		float clearcoatF90;
	#endif
	#ifdef USE_IRIDESCENCE
		float iridescence;
		float iridescenceIOR;
		float iridescenceThickness;
		vec3 iridescenceFresnel;
		vec3 iridescenceF0Dielectric;
		vec3 iridescenceF0Metallic;
	#endif
	#ifdef USE_SHEEN
		vec3 sheenColor;
		float sheenRoughness;
	#endif
	#ifdef IOR
		float ior;
	#endif
	#ifdef USE_TRANSMISSION
		float transmission;
		float transmissionAlpha;
		float thickness;
		float attenuationDistance;
		vec3 attenuationColor;
	#endif
	#ifdef USE_ANISOTROPY
		float anisotropy;
		float alphaT;
		vec3 anisotropyT;
		vec3 anisotropyB;
	#endif
};
vec3 clearcoatSpecularDirect = vec3( 0.0 );
vec3 clearcoatSpecularIndirect = vec3( 0.0 );
vec3 sheenSpecularDirect = vec3( 0.0 );
vec3 sheenSpecularIndirect = vec3(0.0 );
vec3 Schlick_to_F0( const in vec3 f, const in float f90, const in float dotVH ) {
    float x = clamp( 1.0 - dotVH, 0.0, 1.0 );
    float x2 = x * x;
    float x5 = clamp( x * x2 * x2, 0.0, 0.9999 );
    return ( f - vec3( f90 ) * x5 ) / ( 1.0 - x5 );
}
#ifdef USE_DIFFUSE_ROUGHNESS
	const float EON_EPSILON = 1e-7;
	float FON_DirectionalAlbedo( const in float mu, const in float roughness, const in float A ) {
		float muComp = 1.0 - mu;
		float gOverPi = muComp * ( 0.0571085289 + muComp * ( 0.491881867 + muComp * ( - 0.332181442 + muComp * 0.0714429953 ) ) );
		return A * ( 1.0 + roughness * gOverPi );
	}
	vec3 BRDF_EON( const in vec3 lightDir, const in vec3 viewDir, const in vec3 normal, const in vec3 diffuseColor, const in float roughness ) {
		vec3 rho = saturate( diffuseColor );
		if ( roughness <= EON_EPSILON ) return BRDF_Lambert( rho );
		float dotNL = saturate( dot( normal, lightDir ) );
		float dotNV = saturate( dot( normal, viewDir ) );
		float s = dot( lightDir, viewDir ) - dotNL * dotNV;
		float sOverT = ( s > 0.0 ) ? s / max( max( dotNL, dotNV ), EON_EPSILON ) : s;
		float A = 1.0 / ( 1.0 + ( 0.5 - 2.0 / ( 3.0 * PI ) ) * roughness );
		vec3 singleScatter = rho * RECIPROCAL_PI * A * ( 1.0 + roughness * sOverT );
		float averageAlbedo = A * ( 1.0 + ( 2.0 / 3.0 - 28.0 / ( 15.0 * PI ) ) * roughness );
		float albedoV = FON_DirectionalAlbedo( dotNV, roughness, A );
		float albedoL = FON_DirectionalAlbedo( dotNL, roughness, A );
		vec3 rhoMultiScatter = rho * rho * averageAlbedo / max( vec3( EON_EPSILON ), vec3( 1.0 ) - rho * ( 1.0 - averageAlbedo ) );
		vec3 multiScatter = rhoMultiScatter * RECIPROCAL_PI
			* max( EON_EPSILON, 1.0 - albedoV )
			* max( EON_EPSILON, 1.0 - albedoL )
			/ max( EON_EPSILON, 1.0 - averageAlbedo );
		return singleScatter + multiScatter;
	}
	vec3 EON_DirectionalAlbedo( const in vec3 diffuseColor, const in float roughness, const in float dotNV ) {
		vec3 rho = saturate( diffuseColor );
		if ( roughness <= EON_EPSILON ) return rho;
		float A = 1.0 / ( 1.0 + ( 0.5 - 2.0 / ( 3.0 * PI ) ) * roughness );
		float directionalAlbedo = FON_DirectionalAlbedo( dotNV, roughness, A );
		float averageAlbedo = A * ( 1.0 + ( 2.0 / 3.0 - 28.0 / ( 15.0 * PI ) ) * roughness );
		vec3 rhoMultiScatter = rho * rho * averageAlbedo / max( vec3( EON_EPSILON ), vec3( 1.0 ) - rho * ( 1.0 - averageAlbedo ) );
		return rho * directionalAlbedo + rhoMultiScatter * ( 1.0 - directionalAlbedo );
	}
#endif
float V_GGX_SmithCorrelated( const in float alpha, const in float dotNL, const in float dotNV ) {
	float a2 = pow2( alpha );
	float gv = dotNL * sqrt( a2 + ( 1.0 - a2 ) * pow2( dotNV ) );
	float gl = dotNV * sqrt( a2 + ( 1.0 - a2 ) * pow2( dotNL ) );
	return 0.5 / max( gv + gl, EPSILON );
}
float D_GGX( const in float alpha, const in float dotNH ) {
	float a2 = pow2( alpha );
	float denom = pow2( dotNH ) * ( a2 - 1.0 ) + 1.0;
	return RECIPROCAL_PI * a2 / pow2( denom );
}
#ifdef USE_ANISOTROPY
	float V_GGX_SmithCorrelated_Anisotropic( const in float alphaT, const in float alphaB, const in float dotTV, const in float dotBV, const in float dotTL, const in float dotBL, const in float dotNV, const in float dotNL ) {
		float gv = dotNL * length( vec3( alphaT * dotTV, alphaB * dotBV, dotNV ) );
		float gl = dotNV * length( vec3( alphaT * dotTL, alphaB * dotBL, dotNL ) );
		return 0.5 / max( gv + gl, EPSILON );
	}
	float D_GGX_Anisotropic( const in float alphaT, const in float alphaB, const in float dotNH, const in float dotTH, const in float dotBH ) {
		float a2 = alphaT * alphaB;
		highp vec3 v = vec3( alphaB * dotTH, alphaT * dotBH, a2 * dotNH );
		highp float v2 = dot( v, v );
		float w2 = a2 / v2;
		return RECIPROCAL_PI * a2 * pow2 ( w2 );
	}
#endif
#ifdef USE_CLEARCOAT
	vec3 BRDF_GGX_Clearcoat( const in vec3 lightDir, const in vec3 viewDir, const in vec3 normal, const in PhysicalMaterial material) {
		vec3 f0 = material.clearcoatF0;
		float f90 = material.clearcoatF90;
		float roughness = max( material.clearcoatRoughness, 0.045 );
		float alpha = pow2( roughness );
		vec3 halfDir = normalize( lightDir + viewDir );
		float dotNL = saturate( dot( normal, lightDir ) );
		float dotNV = saturate( dot( normal, viewDir ) );
		float dotNH = saturate( dot( normal, halfDir ) );
		float dotVH = saturate( dot( viewDir, halfDir ) );
		vec3 F = F_Schlick( f0, f90, dotVH );
		float V = V_GGX_SmithCorrelated( alpha, dotNL, dotNV );
		float D = D_GGX( alpha, dotNH );
		return F * ( V * D );
	}
#endif
vec3 BRDF_GGX( const in vec3 lightDir, const in vec3 viewDir, const in vec3 normal, const in PhysicalMaterial material ) {
	vec3 f0 = material.specularColorBlended;
	float f90 = material.specularF90;
	float roughness = max( material.roughness, 0.045 );
	float alpha = pow2( roughness );
	vec3 halfDir = normalize( lightDir + viewDir );
	float dotNL = saturate( dot( normal, lightDir ) );
	float dotNV = saturate( dot( normal, viewDir ) );
	float dotNH = saturate( dot( normal, halfDir ) );
	float dotVH = saturate( dot( viewDir, halfDir ) );
	vec3 F = F_Schlick( f0, f90, dotVH );
	#ifdef USE_IRIDESCENCE
		F = mix( F, material.iridescenceFresnel, material.iridescence );
	#endif
	#ifdef USE_ANISOTROPY
		float dotTL = dot( material.anisotropyT, lightDir );
		float dotTV = dot( material.anisotropyT, viewDir );
		float dotTH = dot( material.anisotropyT, halfDir );
		float dotBL = dot( material.anisotropyB, lightDir );
		float dotBV = dot( material.anisotropyB, viewDir );
		float dotBH = dot( material.anisotropyB, halfDir );
		float alphaT = max( material.alphaT, alpha );
		float V = V_GGX_SmithCorrelated_Anisotropic( alphaT, alpha, dotTV, dotBV, dotTL, dotBL, dotNV, dotNL );
		float D = D_GGX_Anisotropic( alphaT, alpha, dotNH, dotTH, dotBH );
	#else
		float V = V_GGX_SmithCorrelated( alpha, dotNL, dotNV );
		float D = D_GGX( alpha, dotNH );
	#endif
	return F * ( V * D );
}
vec2 LTC_Uv( const in vec3 N, const in vec3 V, const in float roughness ) {
	const float LUT_SIZE = 64.0;
	const float LUT_SCALE = ( LUT_SIZE - 1.0 ) / LUT_SIZE;
	const float LUT_BIAS = 0.5 / LUT_SIZE;
	float dotNV = saturate( dot( N, V ) );
	vec2 uv = vec2( roughness, sqrt( 1.0 - dotNV ) );
	uv = uv * LUT_SCALE + LUT_BIAS;
	return uv;
}
float LTC_ClippedSphereFormFactor( const in vec3 f ) {
	float l = length( f );
	return max( ( l * l + f.z ) / ( l + 1.0 ), 0.0 );
}
vec3 LTC_EdgeVectorFormFactor( const in vec3 v1, const in vec3 v2 ) {
	float x = dot( v1, v2 );
	float y = abs( x );
	float a = 0.8543985 + ( 0.4965155 + 0.0145206 * y ) * y;
	float b = 3.4175940 + ( 4.1616724 + y ) * y;
	float v = a / b;
	float theta_sintheta = ( x > 0.0 ) ? v : 0.5 * inversesqrt( max( 1.0 - x * x, 1e-7 ) ) - v;
	return cross( v1, v2 ) * theta_sintheta;
}
vec3 LTC_Evaluate( const in vec3 N, const in vec3 V, const in vec3 P, const in mat3 mInv, const in vec3 rectCoords[ 4 ] ) {
	vec3 v1 = rectCoords[ 1 ] - rectCoords[ 0 ];
	vec3 v2 = rectCoords[ 3 ] - rectCoords[ 0 ];
	vec3 lightNormal = cross( v1, v2 );
	if( dot( lightNormal, P - rectCoords[ 0 ] ) < 0.0 ) return vec3( 0.0 );
	vec3 T1, T2;
	T1 = normalize( V - N * dot( V, N ) );
	T2 = - cross( N, T1 );
	mat3 mat = mInv * transpose( mat3( T1, T2, N ) );
	vec3 coords[ 4 ];
	coords[ 0 ] = mat * ( rectCoords[ 0 ] - P );
	coords[ 1 ] = mat * ( rectCoords[ 1 ] - P );
	coords[ 2 ] = mat * ( rectCoords[ 2 ] - P );
	coords[ 3 ] = mat * ( rectCoords[ 3 ] - P );
	coords[ 0 ] = normalize( coords[ 0 ] );
	coords[ 1 ] = normalize( coords[ 1 ] );
	coords[ 2 ] = normalize( coords[ 2 ] );
	coords[ 3 ] = normalize( coords[ 3 ] );
	vec3 vectorFormFactor = vec3( 0.0 );
	vectorFormFactor += LTC_EdgeVectorFormFactor( coords[ 0 ], coords[ 1 ] );
	vectorFormFactor += LTC_EdgeVectorFormFactor( coords[ 1 ], coords[ 2 ] );
	vectorFormFactor += LTC_EdgeVectorFormFactor( coords[ 2 ], coords[ 3 ] );
	vectorFormFactor += LTC_EdgeVectorFormFactor( coords[ 3 ], coords[ 0 ] );
	float result = LTC_ClippedSphereFormFactor( vectorFormFactor );
	return vec3( result );
}
#if defined( USE_SHEEN )
float D_Charlie( float roughness, float dotNH ) {
	float alpha = pow2( roughness );
	float invAlpha = 1.0 / alpha;
	float cos2h = dotNH * dotNH;
	float sin2h = max( 1.0 - cos2h, 0.0078125 );
	return ( 2.0 + invAlpha ) * pow( sin2h, invAlpha * 0.5 ) / ( 2.0 * PI );
}
float V_Neubelt( float dotNV, float dotNL ) {
	return saturate( 1.0 / ( 4.0 * ( dotNL + dotNV - dotNL * dotNV ) ) );
}
vec3 BRDF_Sheen( const in vec3 lightDir, const in vec3 viewDir, const in vec3 normal, vec3 sheenColor, const in float sheenRoughness ) {
	vec3 halfDir = normalize( lightDir + viewDir );
	float dotNL = saturate( dot( normal, lightDir ) );
	float dotNV = saturate( dot( normal, viewDir ) );
	float dotNH = saturate( dot( normal, halfDir ) );
	float D = D_Charlie( sheenRoughness, dotNH );
	float V = V_Neubelt( dotNV, dotNL );
	return sheenColor * ( D * V );
}
#endif
float IBLSheenBRDF( const in vec3 normal, const in vec3 viewDir, const in float roughness ) {
	float dotNV = saturate( dot( normal, viewDir ) );
	float r2 = roughness * roughness;
	float rInv = 1.0 / ( roughness + 0.1 );
	float a = -1.9362 + 1.0678 * roughness + 0.4573 * r2 - 0.8469 * rInv;
	float b = -0.6014 + 0.5538 * roughness - 0.4670 * r2 - 0.1255 * rInv;
	float DG = exp( a * dotNV + b );
	return saturate( DG );
}
vec3 EnvironmentBRDF( const in vec3 normal, const in vec3 viewDir, const in vec3 specularColor, const in float specularF90, const in float roughness ) {
	float dotNV = saturate( dot( normal, viewDir ) );
	vec2 fab = texture2D( dfgLUT, vec2( roughness, dotNV ) ).rg;
	return specularColor * fab.x + specularF90 * fab.y;
}
#ifdef USE_IRIDESCENCE
void computeMultiscatteringIridescence( const in vec2 fab, const in vec3 specularColor, const in float specularF90, const in float iridescence, const in vec3 iridescenceF0, inout vec3 singleScatter, inout vec3 multiScatter ) {
#else
void computeMultiscattering( const in vec2 fab, const in vec3 specularColor, const in float specularF90, inout vec3 singleScatter, inout vec3 multiScatter ) {
#endif
	#ifdef USE_IRIDESCENCE
		vec3 Fr = mix( specularColor, iridescenceF0, iridescence );
	#else
		vec3 Fr = specularColor;
	#endif
	vec3 FssEss = Fr * fab.x + specularF90 * fab.y;
	float Ess = fab.x + fab.y;
	float Ems = 1.0 - Ess;
	vec3 Favg = Fr + ( 1.0 - Fr ) * 0.047619;	vec3 Fms = FssEss * Favg / ( 1.0 - Ems * Favg );
	singleScatter += FssEss;
	multiScatter += Fms * Ems;
}
#if NUM_RECT_AREA_LIGHTS > 0
	void RE_Direct_RectArea_Physical( const in RectAreaLight rectAreaLight, const in vec3 geometryPosition, const in vec3 geometryNormal, const in vec3 geometryViewDir, const in vec3 geometryClearcoatNormal, const in PhysicalMaterial material, inout ReflectedLight reflectedLight ) {
		vec3 normal = geometryNormal;
		vec3 viewDir = geometryViewDir;
		vec3 position = geometryPosition;
		vec3 lightPos = rectAreaLight.position;
		vec3 halfWidth = rectAreaLight.halfWidth;
		vec3 halfHeight = rectAreaLight.halfHeight;
		vec3 lightColor = rectAreaLight.color;
		float roughness = material.roughness;
		vec3 rectCoords[ 4 ];
		rectCoords[ 0 ] = lightPos + halfWidth - halfHeight;		rectCoords[ 1 ] = lightPos - halfWidth - halfHeight;
		rectCoords[ 2 ] = lightPos - halfWidth + halfHeight;
		rectCoords[ 3 ] = lightPos + halfWidth + halfHeight;
		vec2 uv = LTC_Uv( normal, viewDir, roughness );
		vec4 t1 = texture2D( ltc_1, uv );
		vec4 t2 = texture2D( ltc_2, uv );
		mat3 mInv = mat3(
			vec3( t1.x, 0, t1.y ),
			vec3(    0, 1,    0 ),
			vec3( t1.z, 0, t1.w )
		);
		vec3 fresnel = ( material.specularColorBlended * t2.x + ( material.specularF90 - material.specularColorBlended ) * t2.y );
		reflectedLight.directSpecular += lightColor * fresnel * LTC_Evaluate( normal, viewDir, position, mInv, rectCoords );
		reflectedLight.directDiffuse += lightColor * material.diffuseContribution * LTC_Evaluate( normal, viewDir, position, mat3( 1.0 ), rectCoords );
		#ifdef USE_CLEARCOAT
			vec3 Ncc = geometryClearcoatNormal;
			vec2 uvClearcoat = LTC_Uv( Ncc, viewDir, material.clearcoatRoughness );
			vec4 t1Clearcoat = texture2D( ltc_1, uvClearcoat );
			vec4 t2Clearcoat = texture2D( ltc_2, uvClearcoat );
			mat3 mInvClearcoat = mat3(
				vec3( t1Clearcoat.x, 0, t1Clearcoat.y ),
				vec3(             0, 1,             0 ),
				vec3( t1Clearcoat.z, 0, t1Clearcoat.w )
			);
			vec3 fresnelClearcoat = material.clearcoatF0 * t2Clearcoat.x + ( material.clearcoatF90 - material.clearcoatF0 ) * t2Clearcoat.y;
			clearcoatSpecularDirect += lightColor * fresnelClearcoat * LTC_Evaluate( Ncc, viewDir, position, mInvClearcoat, rectCoords );
		#endif
	}
#endif
void RE_Direct_Physical( const in IncidentLight directLight, const in vec3 geometryPosition, const in vec3 geometryNormal, const in vec3 geometryViewDir, const in vec3 geometryClearcoatNormal, const in PhysicalMaterial material, inout ReflectedLight reflectedLight ) {
	float dotNL = saturate( dot( geometryNormal, directLight.direction ) );
	vec3 irradiance = dotNL * directLight.color;
	#ifdef USE_CLEARCOAT
		float dotNLcc = saturate( dot( geometryClearcoatNormal, directLight.direction ) );
		vec3 ccIrradiance = dotNLcc * directLight.color;
		clearcoatSpecularDirect += ccIrradiance * BRDF_GGX_Clearcoat( directLight.direction, geometryViewDir, geometryClearcoatNormal, material );
	#endif
	#ifdef USE_SHEEN
 
 		sheenSpecularDirect += irradiance * BRDF_Sheen( directLight.direction, geometryViewDir, geometryNormal, material.sheenColor, material.sheenRoughness );
 
 		float sheenAlbedoV = IBLSheenBRDF( geometryNormal, geometryViewDir, material.sheenRoughness );
 		float sheenAlbedoL = IBLSheenBRDF( geometryNormal, directLight.direction, material.sheenRoughness );
 
 		float sheenEnergyComp = 1.0 - max3( material.sheenColor ) * max( sheenAlbedoV, sheenAlbedoL );
 
 		irradiance *= sheenEnergyComp;
 
 	#endif
	vec3 specularBRDF = BRDF_GGX( directLight.direction, geometryViewDir, geometryNormal, material );
	#ifdef USE_RETROREFLECTION
		vec3 retroViewDir = reflect( - geometryViewDir, geometryNormal );
		vec3 retroSpecularBRDF = BRDF_GGX( directLight.direction, retroViewDir, geometryNormal, material );
		specularBRDF = mix( specularBRDF, retroSpecularBRDF, saturate( material.retroreflectivity ) );
	#endif
	reflectedLight.directSpecular += irradiance * specularBRDF * material.multiScatteringCompensation;
	vec3 halfDir = normalize( directLight.direction + geometryViewDir );
	float dotVH = saturate( dot( geometryViewDir, halfDir ) );
	vec3 F = F_Schlick( material.specularColor, material.specularF90, dotVH );
	#ifdef USE_RETROREFLECTION
		vec3 retroHalfDir = normalize( directLight.direction + retroViewDir );
		float dotRetroVH = saturate( dot( retroViewDir, retroHalfDir ) );
		vec3 retroF = F_Schlick( material.specularColor, material.specularF90, dotRetroVH );
		F = mix( F, retroF, saturate( material.retroreflectivity ) );
	#endif
	#ifdef USE_DIFFUSE_ROUGHNESS
		vec3 diffuseBRDF = BRDF_EON( directLight.direction, geometryViewDir, geometryNormal, material.diffuseColor, material.diffuseRoughness ) * ( 1.0 - material.metalness );
	#else
		vec3 diffuseBRDF = BRDF_Lambert( material.diffuseContribution );
	#endif
	reflectedLight.directDiffuse += irradiance * diffuseBRDF * ( 1.0 - F );
}
void RE_IndirectDiffuse_Physical( const in vec3 irradiance, const in vec3 geometryPosition, const in vec3 geometryNormal, const in vec3 geometryViewDir, const in vec3 geometryClearcoatNormal, const in PhysicalMaterial material, inout ReflectedLight reflectedLight ) {
	vec3 singleScattering = vec3( 0.0 );
	vec3 multiScattering = vec3( 0.0 );
	#ifdef USE_IRIDESCENCE
		computeMultiscatteringIridescence( material.dfg, material.specularColor, material.specularF90, material.iridescence, material.iridescenceF0Dielectric, singleScattering, multiScattering );
	#else
		computeMultiscattering( material.dfg, material.specularColor, material.specularF90, singleScattering, multiScattering );
	#endif
	#ifdef USE_DIFFUSE_ROUGHNESS
		float dotNV = saturate( dot( geometryNormal, geometryViewDir ) );
		vec3 diffuseAlbedo = EON_DirectionalAlbedo( material.diffuseColor, material.diffuseRoughness, dotNV ) * ( 1.0 - material.metalness );
		vec3 diffuse = irradiance * RECIPROCAL_PI * diffuseAlbedo * ( 1.0 - singleScattering - multiScattering );
	#else
		vec3 diffuse = irradiance * BRDF_Lambert( material.diffuseContribution ) * ( 1.0 - singleScattering - multiScattering );
	#endif
	#ifdef USE_SHEEN
		float sheenAlbedo = IBLSheenBRDF( geometryNormal, geometryViewDir, material.sheenRoughness );
		sheenSpecularIndirect += irradiance * material.sheenColor * sheenAlbedo * RECIPROCAL_PI;
		float sheenEnergyComp = 1.0 - max3( material.sheenColor ) * sheenAlbedo;
		diffuse *= sheenEnergyComp;
	#endif
	reflectedLight.indirectDiffuse += diffuse;
}
void RE_IndirectSpecular_Physical( const in vec3 radiance, const in vec3 irradiance, const in vec3 clearcoatRadiance, const in vec3 geometryPosition, const in vec3 geometryNormal, const in vec3 geometryViewDir, const in vec3 geometryClearcoatNormal, const in PhysicalMaterial material, inout ReflectedLight reflectedLight) {
	#ifdef USE_CLEARCOAT
		clearcoatSpecularIndirect += clearcoatRadiance * EnvironmentBRDF( geometryClearcoatNormal, geometryViewDir, material.clearcoatF0, material.clearcoatF90, material.clearcoatRoughness );
	#endif
	#ifdef USE_SHEEN
		sheenSpecularIndirect += irradiance * material.sheenColor * IBLSheenBRDF( geometryNormal, geometryViewDir, material.sheenRoughness ) * RECIPROCAL_PI;
 	#endif
	vec3 singleScatteringDielectric = vec3( 0.0 );
	vec3 multiScatteringDielectric = vec3( 0.0 );
	vec3 singleScatteringMetallic = vec3( 0.0 );
	vec3 multiScatteringMetallic = vec3( 0.0 );
	#ifdef USE_IRIDESCENCE
		computeMultiscatteringIridescence( material.dfg, material.specularColor, material.specularF90, material.iridescence, material.iridescenceF0Dielectric, singleScatteringDielectric, multiScatteringDielectric );
		computeMultiscatteringIridescence( material.dfg, material.diffuseColor, material.specularF90, material.iridescence, material.iridescenceF0Metallic, singleScatteringMetallic, multiScatteringMetallic );
	#else
		computeMultiscattering( material.dfg, material.specularColor, material.specularF90, singleScatteringDielectric, multiScatteringDielectric );
		computeMultiscattering( material.dfg, material.diffuseColor, material.specularF90, singleScatteringMetallic, multiScatteringMetallic );
	#endif
	vec3 singleScattering = mix( singleScatteringDielectric, singleScatteringMetallic, material.metalness );
	vec3 multiScattering = mix( multiScatteringDielectric, multiScatteringMetallic, material.metalness );
	vec3 totalScatteringDielectric = singleScatteringDielectric + multiScatteringDielectric;
	#ifdef USE_DIFFUSE_ROUGHNESS
		float dotNV = saturate( dot( geometryNormal, geometryViewDir ) );
		vec3 diffuse = EON_DirectionalAlbedo( material.diffuseColor, material.diffuseRoughness, dotNV ) * ( 1.0 - material.metalness ) * ( 1.0 - totalScatteringDielectric );
	#else
		vec3 diffuse = material.diffuseContribution * ( 1.0 - totalScatteringDielectric );
	#endif
	vec3 cosineWeightedIrradiance = irradiance * RECIPROCAL_PI;
	vec3 indirectSpecular = radiance * singleScattering;
	indirectSpecular += multiScattering * cosineWeightedIrradiance;
	vec3 indirectDiffuse = diffuse * cosineWeightedIrradiance;
	#ifdef USE_SHEEN
		float sheenAlbedo = IBLSheenBRDF( geometryNormal, geometryViewDir, material.sheenRoughness );
		float sheenEnergyComp = 1.0 - max3( material.sheenColor ) * sheenAlbedo;
		indirectSpecular *= sheenEnergyComp;
		indirectDiffuse *= sheenEnergyComp;
	#endif
	reflectedLight.indirectSpecular += indirectSpecular;
	reflectedLight.indirectDiffuse += indirectDiffuse;
}
#define RE_Direct				RE_Direct_Physical
#define RE_Direct_RectArea		RE_Direct_RectArea_Physical
#define RE_IndirectDiffuse		RE_IndirectDiffuse_Physical
#define RE_IndirectSpecular		RE_IndirectSpecular_Physical
float computeSpecularOcclusion( const in float dotNV, const in float ambientOcclusion, const in float roughness ) {
	return saturate( pow( dotNV + ambientOcclusion, exp2( - 16.0 * roughness - 1.0 ) ) - 1.0 + ambientOcclusion );
}`,tS=`
vec3 geometryPosition = - vViewPosition;
vec3 geometryNormal = normal;
vec3 geometryViewDir = ( isOrthographic ) ? vec3( 0, 0, 1 ) : normalize( vViewPosition );
vec3 geometryClearcoatNormal = vec3( 0.0 );
#ifdef USE_CLEARCOAT
	geometryClearcoatNormal = clearcoatNormal;
#endif
#ifdef USE_IRIDESCENCE
	float dotNVi = saturate( dot( normal, geometryViewDir ) );
	if ( material.iridescenceThickness == 0.0 ) {
		material.iridescence = 0.0;
	} else {
		material.iridescence = saturate( material.iridescence );
	}
	if ( material.iridescence > 0.0 ) {
		vec3 iridescenceFresnelDielectric = evalIridescence( 1.0, material.iridescenceIOR, dotNVi, material.iridescenceThickness, material.specularColor );
		vec3 iridescenceFresnelMetallic = evalIridescence( 1.0, material.iridescenceIOR, dotNVi, material.iridescenceThickness, material.diffuseColor );
		material.iridescenceFresnel = mix( iridescenceFresnelDielectric, iridescenceFresnelMetallic, material.metalness );
		material.iridescenceF0Dielectric = Schlick_to_F0( iridescenceFresnelDielectric, 1.0, dotNVi );
		material.iridescenceF0Metallic = Schlick_to_F0( iridescenceFresnelMetallic, 1.0, dotNVi );
	}
#endif
#ifdef STANDARD
	float dotNVms = saturate( dot( geometryNormal, geometryViewDir ) );
	material.dfg = texture2D( dfgLUT, vec2( material.roughness, dotNVms ) ).rg;
	#if ( NUM_SUN_LIGHTS > 0 || NUM_DIR_LIGHTS > 0 || NUM_POINT_LIGHTS > 0 || NUM_SPOT_LIGHTS > 0 )
		float EssMs = material.dfg.x + material.dfg.y;
		material.multiScatteringCompensation = 1.0 + material.specularColorBlended * ( 1.0 / EssMs - 1.0 );
	#endif
#endif
IncidentLight directLight;
#if ( NUM_POINT_LIGHTS > 0 ) && defined( RE_Direct )
	PointLight pointLight;
	#if defined( USE_SHADOWMAP ) && NUM_POINT_LIGHT_SHADOWS > 0
	PointLightShadow pointLightShadow;
	#endif
	#pragma unroll_loop_start
	for ( int i = 0; i < NUM_POINT_LIGHTS; i ++ ) {
		pointLight = pointLights[ i ];
		getPointLightInfo( pointLight, geometryPosition, directLight );
		#if defined( USE_SHADOWMAP ) && ( UNROLLED_LOOP_INDEX < NUM_POINT_LIGHT_SHADOWS ) && ( defined( SHADOWMAP_TYPE_PCF ) || defined( SHADOWMAP_TYPE_BASIC ) )
		pointLightShadow = pointLightShadows[ i ];
		directLight.color *= ( directLight.visible && receiveShadow ) ? getPointShadow( pointShadowMap[ i ], pointLightShadow.shadowMapSize, pointLightShadow.shadowIntensity, pointLightShadow.shadowBias, pointLightShadow.shadowRadius, vPointShadowCoord[ i ], pointLightShadow.shadowCameraNear, pointLightShadow.shadowCameraFar ) : 1.0;
		#endif
		RE_Direct( directLight, geometryPosition, geometryNormal, geometryViewDir, geometryClearcoatNormal, material, reflectedLight );
	}
	#pragma unroll_loop_end
#endif
#if ( NUM_SPOT_LIGHTS > 0 ) && defined( RE_Direct )
	SpotLight spotLight;
	vec4 spotColor;
	vec3 spotLightCoord;
	bool inSpotLightMap;
	#if defined( USE_SHADOWMAP ) && NUM_SPOT_LIGHT_SHADOWS > 0
	SpotLightShadow spotLightShadow;
	#endif
	#pragma unroll_loop_start
	for ( int i = 0; i < NUM_SPOT_LIGHTS; i ++ ) {
		spotLight = spotLights[ i ];
		getSpotLightInfo( spotLight, geometryPosition, directLight );
		#if ( UNROLLED_LOOP_INDEX < NUM_SPOT_LIGHT_SHADOWS_WITH_MAPS )
		#define SPOT_LIGHT_MAP_INDEX UNROLLED_LOOP_INDEX
		#elif ( UNROLLED_LOOP_INDEX < NUM_SPOT_LIGHT_SHADOWS )
		#define SPOT_LIGHT_MAP_INDEX NUM_SPOT_LIGHT_MAPS
		#else
		#define SPOT_LIGHT_MAP_INDEX ( UNROLLED_LOOP_INDEX - NUM_SPOT_LIGHT_SHADOWS + NUM_SPOT_LIGHT_SHADOWS_WITH_MAPS )
		#endif
		#if ( SPOT_LIGHT_MAP_INDEX < NUM_SPOT_LIGHT_MAPS )
			spotLightCoord = vSpotLightCoord[ i ].xyz / vSpotLightCoord[ i ].w;
			inSpotLightMap = all( lessThan( abs( spotLightCoord * 2. - 1. ), vec3( 1.0 ) ) );
			spotColor = texture2D( spotLightMap[ SPOT_LIGHT_MAP_INDEX ], spotLightCoord.xy );
			directLight.color = inSpotLightMap ? directLight.color * spotColor.rgb : directLight.color;
		#endif
		#undef SPOT_LIGHT_MAP_INDEX
		#if defined( USE_SHADOWMAP ) && ( UNROLLED_LOOP_INDEX < NUM_SPOT_LIGHT_SHADOWS )
		spotLightShadow = spotLightShadows[ i ];
		directLight.color *= ( directLight.visible && receiveShadow ) ? getShadow( spotShadowMap[ i ], spotLightShadow.shadowMapSize, spotLightShadow.shadowIntensity, spotLightShadow.shadowBias, spotLightShadow.shadowRadius, vSpotLightCoord[ i ] ) : 1.0;
		#endif
		RE_Direct( directLight, geometryPosition, geometryNormal, geometryViewDir, geometryClearcoatNormal, material, reflectedLight );
	}
	#pragma unroll_loop_end
#endif
#if ( NUM_SUN_LIGHTS > 0 ) && defined( RE_Direct )
	SunLight sunLight;
	#if defined( USE_SHADOWMAP ) && NUM_SUN_LIGHT_SHADOWS > 0
	SunLightShadow sunLightShadow;
	#endif
	#pragma unroll_loop_start
	for ( int i = 0; i < NUM_SUN_LIGHTS; i ++ ) {
		sunLight = sunLights[ i ];
		getSunLightInfo( sunLight, directLight );
		#if defined( USE_SHADOWMAP ) && ( UNROLLED_LOOP_INDEX < NUM_SUN_LIGHT_SHADOWS )
		sunLightShadow = sunLightShadows[ i ];
		directLight.color *= ( directLight.visible && receiveShadow ) ? getSunShadow( sunShadowMap[ i ], sunLightShadow, UNROLLED_LOOP_INDEX ) : 1.0;
		#endif
		RE_Direct( directLight, geometryPosition, geometryNormal, geometryViewDir, geometryClearcoatNormal, material, reflectedLight );
	}
	#pragma unroll_loop_end
#endif
#if ( NUM_DIR_LIGHTS > 0 ) && defined( RE_Direct )
	DirectionalLight directionalLight;
	#if defined( USE_SHADOWMAP ) && NUM_DIR_LIGHT_SHADOWS > 0
	DirectionalLightShadow directionalLightShadow;
	#endif
	#pragma unroll_loop_start
	for ( int i = 0; i < NUM_DIR_LIGHTS; i ++ ) {
		directionalLight = directionalLights[ i ];
		getDirectionalLightInfo( directionalLight, directLight );
		#if defined( USE_SHADOWMAP ) && ( UNROLLED_LOOP_INDEX < NUM_DIR_LIGHT_SHADOWS )
		directionalLightShadow = directionalLightShadows[ i ];
		directLight.color *= ( directLight.visible && receiveShadow ) ? getShadow( directionalShadowMap[ i ], directionalLightShadow.shadowMapSize, directionalLightShadow.shadowIntensity, directionalLightShadow.shadowBias, directionalLightShadow.shadowRadius, vDirectionalShadowCoord[ i ] ) : 1.0;
		#endif
		RE_Direct( directLight, geometryPosition, geometryNormal, geometryViewDir, geometryClearcoatNormal, material, reflectedLight );
	}
	#pragma unroll_loop_end
#endif
#if ( NUM_RECT_AREA_LIGHTS > 0 ) && defined( RE_Direct_RectArea )
	RectAreaLight rectAreaLight;
	#pragma unroll_loop_start
	for ( int i = 0; i < NUM_RECT_AREA_LIGHTS; i ++ ) {
		rectAreaLight = rectAreaLights[ i ];
		RE_Direct_RectArea( rectAreaLight, geometryPosition, geometryNormal, geometryViewDir, geometryClearcoatNormal, material, reflectedLight );
	}
	#pragma unroll_loop_end
#endif
#if defined( RE_IndirectDiffuse )
	vec3 iblIrradiance = vec3( 0.0 );
	vec3 irradiance = getAmbientLightIrradiance( ambientLightColor );
	#if defined( USE_LIGHT_PROBES )
		irradiance += getLightProbeIrradiance( lightProbe, geometryNormal );
	#endif
	#if ( NUM_HEMI_LIGHTS > 0 )
		#pragma unroll_loop_start
		for ( int i = 0; i < NUM_HEMI_LIGHTS; i ++ ) {
			irradiance += getHemisphereLightIrradiance( hemisphereLights[ i ], geometryNormal );
		}
		#pragma unroll_loop_end
	#endif
	#if NUM_LIGHT_PROBE_GRIDS > 0
		vec3 probeWorldPos = ( ( vec4( geometryPosition, 1.0 ) - viewMatrix[ 3 ] ) * viewMatrix ).xyz;
		vec3 probeWorldNormal = transformNormalByInverseViewMatrix( geometryNormal, viewMatrix );
		int probeGrid = - 1;
		#pragma unroll_loop_start
		for ( int i = 0; i < NUM_LIGHT_PROBE_GRIDS; i ++ ) {
			if ( isInsideLightProbeGrid( probeWorldPos, probeWorldNormal, probesMin[ i ], probesMax[ i ], probesResolution[ i ] ) ) probeGrid = UNROLLED_LOOP_INDEX;
		}
		#pragma unroll_loop_end
		#pragma unroll_loop_start
		for ( int i = 0; i < NUM_LIGHT_PROBE_GRIDS; i ++ ) {
			if ( probeGrid == UNROLLED_LOOP_INDEX ) irradiance += getLightProbeGridIrradiance( probesSH[ i ], probesMin[ i ], probesMax[ i ], probesResolution[ i ], probeWorldPos, probeWorldNormal );
		}
		#pragma unroll_loop_end
	#endif
#endif
#if defined( RE_IndirectSpecular )
	vec3 radiance = vec3( 0.0 );
	vec3 clearcoatRadiance = vec3( 0.0 );
#endif`,eS=`#if defined( RE_IndirectDiffuse )
	#ifdef USE_LIGHTMAP
		vec4 lightMapTexel = texture2D( lightMap, vLightMapUv );
		vec3 lightMapIrradiance = lightMapTexel.rgb * lightMapIntensity;
		irradiance += lightMapIrradiance;
	#endif
	#if defined( USE_ENVMAP ) && defined( ENVMAP_TYPE_PMREM )
		#if defined( STANDARD ) || defined( LAMBERT ) || defined( PHONG )
			iblIrradiance += getIBLIrradiance( geometryNormal );
		#endif
	#endif
#endif
#if defined( USE_ENVMAP ) && defined( RE_IndirectSpecular )
	#ifdef USE_ANISOTROPY
		vec3 iblRadiance = getIBLAnisotropyRadiance( geometryViewDir, geometryNormal, material.roughness, material.anisotropyB, material.anisotropy );
	#else
		vec3 iblRadiance = getIBLRadiance( geometryViewDir, geometryNormal, material.roughness );
	#endif
	#ifdef USE_RETROREFLECTION
		#ifdef USE_ANISOTROPY
			vec3 retroIBLRadiance = getIBLAnisotropyRetroRadiance( geometryViewDir, geometryNormal, material.roughness, material.anisotropyB, material.anisotropy );
		#else
			vec3 retroIBLRadiance = getIBLRetroRadiance( geometryViewDir, geometryNormal, material.roughness );
		#endif
		iblRadiance = mix( iblRadiance, retroIBLRadiance, saturate( material.retroreflectivity ) );
	#endif
	radiance += iblRadiance;
	#ifdef USE_CLEARCOAT
		clearcoatRadiance += getIBLRadiance( geometryViewDir, geometryClearcoatNormal, material.clearcoatRoughness );
	#endif
#endif`,nS=`#if defined( RE_IndirectDiffuse )
	#if defined( LAMBERT ) || defined( PHONG )
		irradiance += iblIrradiance;
	#endif
	RE_IndirectDiffuse( irradiance, geometryPosition, geometryNormal, geometryViewDir, geometryClearcoatNormal, material, reflectedLight );
#endif
#if defined( RE_IndirectSpecular )
	RE_IndirectSpecular( radiance, iblIrradiance, clearcoatRadiance, geometryPosition, geometryNormal, geometryViewDir, geometryClearcoatNormal, material, reflectedLight );
#endif`,iS=`#if NUM_LIGHT_PROBE_GRIDS > 0
uniform highp sampler3D probesSH[ NUM_LIGHT_PROBE_GRIDS ];
uniform vec3 probesMin[ NUM_LIGHT_PROBE_GRIDS ];
uniform vec3 probesMax[ NUM_LIGHT_PROBE_GRIDS ];
uniform vec3 probesResolution[ NUM_LIGHT_PROBE_GRIDS ];
bool isInsideLightProbeGrid( vec3 worldPos, vec3 worldNormal, vec3 probesMin, vec3 probesMax, vec3 probesResolution ) {
	vec3 spacing = ( probesMax - probesMin ) / probesResolution;
	vec3 samplePos = worldPos + worldNormal * spacing * 0.5;
	vec3 margin = spacing * 0.01;
	return all( greaterThanEqual( samplePos, probesMin - margin ) ) && all( lessThanEqual( samplePos, probesMax + margin ) );
}
vec3 getLightProbeGridIrradiance( highp sampler3D probesSH, vec3 probesMin, vec3 probesMax, vec3 probesResolution, vec3 worldPos, vec3 worldNormal ) {
	vec3 res = probesResolution;
	vec3 gridRange = probesMax - probesMin;
	vec3 probeSpacing = gridRange / res;
	vec3 samplePos = worldPos + worldNormal * probeSpacing * 0.5;
	vec3 uvw = clamp( ( samplePos - probesMin ) / gridRange, 0.5 / res, 1.0 - 0.5 / res );
	float nz          = res.z;
	float paddedSlices = nz + 2.0;
	float atlasDepth  = 7.0 * paddedSlices;
	float uvZBase     = uvw.z * nz + 1.0;
	vec4 s0 = texture( probesSH, vec3( uvw.xy, ( uvZBase                       ) / atlasDepth ) );
	vec4 s1 = texture( probesSH, vec3( uvw.xy, ( uvZBase +       paddedSlices   ) / atlasDepth ) );
	vec4 s2 = texture( probesSH, vec3( uvw.xy, ( uvZBase + 2.0 * paddedSlices   ) / atlasDepth ) );
	vec4 s3 = texture( probesSH, vec3( uvw.xy, ( uvZBase + 3.0 * paddedSlices   ) / atlasDepth ) );
	vec4 s4 = texture( probesSH, vec3( uvw.xy, ( uvZBase + 4.0 * paddedSlices   ) / atlasDepth ) );
	vec4 s5 = texture( probesSH, vec3( uvw.xy, ( uvZBase + 5.0 * paddedSlices   ) / atlasDepth ) );
	vec4 s6 = texture( probesSH, vec3( uvw.xy, ( uvZBase + 6.0 * paddedSlices   ) / atlasDepth ) );
	vec3 c0 = s0.xyz;
	vec3 c1 = vec3( s0.w, s1.xy );
	vec3 c2 = vec3( s1.zw, s2.x );
	vec3 c3 = s2.yzw;
	vec3 c4 = s3.xyz;
	vec3 c5 = vec3( s3.w, s4.xy );
	vec3 c6 = vec3( s4.zw, s5.x );
	vec3 c7 = s5.yzw;
	vec3 c8 = s6.xyz;
	float x = worldNormal.x, y = worldNormal.y, z = worldNormal.z;
	vec3 result = c0 * 0.886227;
	result += c1 * 2.0 * 0.511664 * y;
	result += c2 * 2.0 * 0.511664 * z;
	result += c3 * 2.0 * 0.511664 * x;
	result += c4 * 2.0 * 0.429043 * x * y;
	result += c5 * 2.0 * 0.429043 * y * z;
	result += c6 * ( 0.743125 * z * z - 0.247708 );
	result += c7 * 2.0 * 0.429043 * x * z;
	result += c8 * 0.429043 * ( x * x - y * y );
	return max( result, vec3( 0.0 ) );
}
#endif`,sS=`#if defined( USE_LOGARITHMIC_DEPTH_BUFFER )
	gl_FragDepth = vIsPerspective == 0.0 ? gl_FragCoord.z : log2( vFragDepth ) * logDepthBufFC * 0.5;
#endif`,rS=`#if defined( USE_LOGARITHMIC_DEPTH_BUFFER )
	uniform float logDepthBufFC;
	varying float vFragDepth;
	varying float vIsPerspective;
#endif`,oS=`#ifdef USE_LOGARITHMIC_DEPTH_BUFFER
	varying float vFragDepth;
	varying float vIsPerspective;
#endif`,aS=`#ifdef USE_LOGARITHMIC_DEPTH_BUFFER
	vFragDepth = 1.0 + gl_Position.w;
	vIsPerspective = float( isPerspectiveMatrix( projectionMatrix ) );
#endif`,lS=`#ifdef USE_MAP
	vec4 sampledDiffuseColor = texture2D( map, vMapUv );
	#ifdef DECODE_VIDEO_TEXTURE
		sampledDiffuseColor = sRGBTransferEOTF( sampledDiffuseColor );
	#endif
	diffuseColor *= sampledDiffuseColor;
#endif`,cS=`#ifdef USE_MAP
	uniform sampler2D map;
#endif`,hS=`#if defined( USE_MAP ) || defined( USE_ALPHAMAP )
	#if defined( USE_POINTS_UV )
		vec2 uv = vUv;
	#else
		vec2 uv = ( uvTransform * vec3( gl_PointCoord.x, 1.0 - gl_PointCoord.y, 1 ) ).xy;
	#endif
#endif
#ifdef USE_MAP
	diffuseColor *= texture2D( map, uv );
#endif
#ifdef USE_ALPHAMAP
	diffuseColor.a *= texture2D( alphaMap, uv ).g;
#endif`,uS=`#if defined( USE_POINTS_UV )
	varying vec2 vUv;
#else
	#if defined( USE_MAP ) || defined( USE_ALPHAMAP )
		uniform mat3 uvTransform;
	#endif
#endif
#ifdef USE_MAP
	uniform sampler2D map;
#endif
#ifdef USE_ALPHAMAP
	uniform sampler2D alphaMap;
#endif`,fS=`float metalnessFactor = metalness;
#ifdef USE_METALNESSMAP
	vec4 texelMetalness = texture2D( metalnessMap, vMetalnessMapUv );
	metalnessFactor *= texelMetalness.b;
#endif`,dS=`#ifdef USE_METALNESSMAP
	uniform sampler2D metalnessMap;
#endif`,pS=`#ifdef USE_INSTANCING_MORPH
	float morphTargetInfluences[ MORPHTARGETS_COUNT ];
	float morphTargetBaseInfluence = texelFetch( morphTexture, ivec2( 0, gl_InstanceID ), 0 ).r;
	for ( int i = 0; i < MORPHTARGETS_COUNT; i ++ ) {
		morphTargetInfluences[i] =  texelFetch( morphTexture, ivec2( i + 1, gl_InstanceID ), 0 ).r;
	}
#endif`,mS=`#if defined( USE_MORPHCOLORS )
	#if defined( USE_COLOR_ALPHA )
		vColor *= morphTargetBaseInfluence;
	#elif defined( USE_COLOR )
		vColor.rgb *= morphTargetBaseInfluence;
	#endif
	for ( int i = 0; i < MORPHTARGETS_COUNT; i ++ ) {
		#if defined( USE_COLOR_ALPHA )
			if ( morphTargetInfluences[ i ] != 0.0 ) vColor += getMorph( gl_VertexID, i, 2 ) * morphTargetInfluences[ i ];
		#elif defined( USE_COLOR )
			if ( morphTargetInfluences[ i ] != 0.0 ) vColor.rgb += getMorph( gl_VertexID, i, 2 ).rgb * morphTargetInfluences[ i ];
		#endif
	}
#endif`,gS=`#ifdef USE_MORPHNORMALS
	objectNormal *= morphTargetBaseInfluence;
	for ( int i = 0; i < MORPHTARGETS_COUNT; i ++ ) {
		if ( morphTargetInfluences[ i ] != 0.0 ) objectNormal += getMorph( gl_VertexID, i, 1 ).xyz * morphTargetInfluences[ i ];
	}
#endif`,_S=`#ifdef USE_MORPHTARGETS
	#ifndef USE_INSTANCING_MORPH
		uniform float morphTargetBaseInfluence;
		uniform float morphTargetInfluences[ MORPHTARGETS_COUNT ];
	#endif
	uniform sampler2DArray morphTargetsTexture;
	uniform ivec2 morphTargetsTextureSize;
	vec4 getMorph( const in int vertexIndex, const in int morphTargetIndex, const in int offset ) {
		int texelIndex = vertexIndex * MORPHTARGETS_TEXTURE_STRIDE + offset;
		int y = texelIndex / morphTargetsTextureSize.x;
		int x = texelIndex - y * morphTargetsTextureSize.x;
		ivec3 morphUV = ivec3( x, y, morphTargetIndex );
		return texelFetch( morphTargetsTexture, morphUV, 0 );
	}
#endif`,xS=`#ifdef USE_MORPHTARGETS
	transformed *= morphTargetBaseInfluence;
	for ( int i = 0; i < MORPHTARGETS_COUNT; i ++ ) {
		if ( morphTargetInfluences[ i ] != 0.0 ) transformed += getMorph( gl_VertexID, i, 0 ).xyz * morphTargetInfluences[ i ];
	}
#endif`,yS=`float faceDirection = gl_FrontFacing ? 1.0 : - 1.0;
#ifdef FLAT_SHADED
	vec3 fdx = dFdx( vViewPosition );
	vec3 fdy = dFdy( vViewPosition );
	vec3 normal = normalize( cross( fdx, fdy ) );
#else
	vec3 normal = normalize( vNormal );
	#ifdef DOUBLE_SIDED
		normal *= faceDirection;
	#endif
#endif
#if defined( USE_NORMALMAP_TANGENTSPACE ) || defined( USE_CLEARCOAT_NORMALMAP ) || defined( USE_ANISOTROPY )
	#ifdef USE_TANGENT
		mat3 tbn = mat3( normalize( vTangent ), normalize( vBitangent ), normal );
	#else
		mat3 tbn = getTangentFrame( - vViewPosition, normal,
		#if defined( USE_NORMALMAP )
			vNormalMapUv
		#elif defined( USE_CLEARCOAT_NORMALMAP )
			vClearcoatNormalMapUv
		#else
			vUv
		#endif
		);
	#endif
	#ifdef DOUBLE_SIDED
		tbn[0] *= faceDirection;
		tbn[1] *= faceDirection;
	#endif
#endif
#ifdef USE_CLEARCOAT_NORMALMAP
	#ifdef USE_TANGENT
		mat3 tbn2 = mat3( normalize( vTangent ), normalize( vBitangent ), normal );
	#else
		mat3 tbn2 = getTangentFrame( - vViewPosition, normal, vClearcoatNormalMapUv );
	#endif
	#ifdef DOUBLE_SIDED
		tbn2[0] *= faceDirection;
		tbn2[1] *= faceDirection;
	#endif
#endif
vec3 nonPerturbedNormal = normal;`,vS=`#ifdef USE_NORMALMAP_OBJECTSPACE
	normal = texture2D( normalMap, vNormalMapUv ).xyz * 2.0 - 1.0;
	#ifdef FLIP_SIDED
		normal = - normal;
	#endif
	#ifdef DOUBLE_SIDED
		normal = normal * faceDirection;
	#endif
	normal = normalize( normalMatrix * normal );
#elif defined( USE_NORMALMAP_TANGENTSPACE )
	vec3 mapN = texture2D( normalMap, vNormalMapUv ).xyz * 2.0 - 1.0;
	#if defined( USE_PACKED_NORMALMAP )
		mapN = vec3( mapN.xy, sqrt( saturate( 1.0 - dot( mapN.xy, mapN.xy ) ) ) );
	#endif
	mapN.xy *= normalScale;
	normal = normalize( tbn * mapN );
#elif defined( USE_BUMPMAP )
	normal = perturbNormalArb( - vViewPosition, normal, dHdxy_fwd(), faceDirection );
#endif`,bS=`#ifndef FLAT_SHADED
	varying vec3 vNormal;
	#ifdef USE_TANGENT
		varying vec3 vTangent;
		varying vec3 vBitangent;
	#endif
#endif`,MS=`#ifndef FLAT_SHADED
	varying vec3 vNormal;
	#ifdef USE_TANGENT
		varying vec3 vTangent;
		varying vec3 vBitangent;
	#endif
#endif`,SS=`#ifndef FLAT_SHADED
	vNormal = normalize( transformedNormal );
	#ifdef USE_TANGENT
		vTangent = normalize( transformedTangent );
		vBitangent = normalize( cross( vNormal, vTangent ) * tangent.w );
		#ifdef FLIP_SIDED
			vBitangent = - vBitangent;
		#endif
	#endif
#endif`,wS=`#ifdef USE_NORMALMAP
	uniform sampler2D normalMap;
	uniform vec2 normalScale;
#endif
#ifdef USE_NORMALMAP_OBJECTSPACE
	uniform mat3 normalMatrix;
#endif
#if ! defined ( USE_TANGENT ) && ( defined ( USE_NORMALMAP_TANGENTSPACE ) || defined ( USE_CLEARCOAT_NORMALMAP ) || defined( USE_ANISOTROPY ) )
	mat3 getTangentFrame( vec3 eye_pos, vec3 surf_norm, vec2 uv ) {
		vec3 q0 = dFdx( eye_pos.xyz );
		vec3 q1 = dFdy( eye_pos.xyz );
		vec2 st0 = dFdx( uv.st );
		vec2 st1 = dFdy( uv.st );
		vec3 N = surf_norm;
		vec3 q1perp = cross( q1, N );
		vec3 q0perp = cross( N, q0 );
		vec3 T = q1perp * st0.x + q0perp * st1.x;
		vec3 B = q1perp * st0.y + q0perp * st1.y;
		float det = max( dot( T, T ), dot( B, B ) );
		float scale = ( det == 0.0 ) ? 0.0 : inversesqrt( det );
		return mat3( T * scale, B * scale, N );
	}
#endif`,AS=`#ifdef USE_CLEARCOAT
	vec3 clearcoatNormal = nonPerturbedNormal;
#endif`,ES=`#ifdef USE_CLEARCOAT_NORMALMAP
	vec3 clearcoatMapN = texture2D( clearcoatNormalMap, vClearcoatNormalMapUv ).xyz * 2.0 - 1.0;
	clearcoatMapN.xy *= clearcoatNormalScale;
	clearcoatNormal = normalize( tbn2 * clearcoatMapN );
#endif`,TS=`#ifdef USE_CLEARCOATMAP
	uniform sampler2D clearcoatMap;
#endif
#ifdef USE_CLEARCOAT_NORMALMAP
	uniform sampler2D clearcoatNormalMap;
	uniform vec2 clearcoatNormalScale;
#endif
#ifdef USE_CLEARCOAT_ROUGHNESSMAP
	uniform sampler2D clearcoatRoughnessMap;
#endif`,CS=`#ifdef USE_IRIDESCENCEMAP
	uniform sampler2D iridescenceMap;
#endif
#ifdef USE_IRIDESCENCE_THICKNESSMAP
	uniform sampler2D iridescenceThicknessMap;
#endif`,RS=`#ifdef OPAQUE
diffuseColor.a = 1.0;
#endif
#ifdef USE_TRANSMISSION
diffuseColor.a *= material.transmissionAlpha;
#endif
gl_FragColor = vec4( outgoingLight, diffuseColor.a );`,PS=`vec3 packNormalToRGB( const in vec3 normal ) {
	return normalize( normal ) * 0.5 + 0.5;
}
vec3 unpackRGBToNormal( const in vec3 rgb ) {
	return 2.0 * rgb.xyz - 1.0;
}
const float PackUpscale = 256. / 255.;const float UnpackDownscale = 255. / 256.;const float ShiftRight8 = 1. / 256.;
const float Inv255 = 1. / 255.;
const vec4 PackFactors = vec4( 1.0, 256.0, 256.0 * 256.0, 256.0 * 256.0 * 256.0 );
const vec2 UnpackFactors2 = vec2( UnpackDownscale, 1.0 / PackFactors.g );
const vec3 UnpackFactors3 = vec3( UnpackDownscale / PackFactors.rg, 1.0 / PackFactors.b );
const vec4 UnpackFactors4 = vec4( UnpackDownscale / PackFactors.rgb, 1.0 / PackFactors.a );
vec4 packDepthToRGBA( const in float v ) {
	if( v <= 0.0 )
		return vec4( 0., 0., 0., 0. );
	if( v >= 1.0 )
		return vec4( 1., 1., 1., 1. );
	float vuf;
	float af = modf( v * PackFactors.a, vuf );
	float bf = modf( vuf * ShiftRight8, vuf );
	float gf = modf( vuf * ShiftRight8, vuf );
	return vec4( vuf * Inv255, gf * PackUpscale, bf * PackUpscale, af );
}
vec3 packDepthToRGB( const in float v ) {
	if( v <= 0.0 )
		return vec3( 0., 0., 0. );
	if( v >= 1.0 )
		return vec3( 1., 1., 1. );
	float vuf;
	float bf = modf( v * PackFactors.b, vuf );
	float gf = modf( vuf * ShiftRight8, vuf );
	return vec3( vuf * Inv255, gf * PackUpscale, bf );
}
vec2 packDepthToRG( const in float v ) {
	if( v <= 0.0 )
		return vec2( 0., 0. );
	if( v >= 1.0 )
		return vec2( 1., 1. );
	float vuf;
	float gf = modf( v * 256., vuf );
	return vec2( vuf * Inv255, gf );
}
float unpackRGBAToDepth( const in vec4 v ) {
	return dot( v, UnpackFactors4 );
}
float unpackRGBToDepth( const in vec3 v ) {
	return dot( v, UnpackFactors3 );
}
float unpackRGToDepth( const in vec2 v ) {
	return v.r * UnpackFactors2.r + v.g * UnpackFactors2.g;
}
vec4 pack2HalfToRGBA( const in vec2 v ) {
	vec4 r = vec4( v.x, fract( v.x * 255.0 ), v.y, fract( v.y * 255.0 ) );
	return vec4( r.x - r.y / 255.0, r.y, r.z - r.w / 255.0, r.w );
}
vec2 unpackRGBATo2Half( const in vec4 v ) {
	return vec2( v.x + ( v.y / 255.0 ), v.z + ( v.w / 255.0 ) );
}
float viewZToOrthographicDepth( const in float viewZ, const in float near, const in float far ) {
	return ( viewZ + near ) / ( near - far );
}
float orthographicDepthToViewZ( const in float depth, const in float near, const in float far ) {
	#ifdef USE_REVERSED_DEPTH_BUFFER
	
		return depth * ( far - near ) - far;
	#else
		return depth * ( near - far ) - near;
	#endif
}
float viewZToPerspectiveDepth( const in float viewZ, const in float near, const in float far ) {
	return ( ( near + viewZ ) * far ) / ( ( far - near ) * viewZ );
}
float perspectiveDepthToViewZ( const in float depth, const in float near, const in float far ) {
	
	#ifdef USE_REVERSED_DEPTH_BUFFER
		return ( near * far ) / ( ( near - far ) * depth - near );
	#else
		return ( near * far ) / ( ( far - near ) * depth - far );
	#endif
}`,IS=`#ifdef PREMULTIPLIED_ALPHA
	gl_FragColor.rgb *= gl_FragColor.a;
#endif`,LS=`vec4 mvPosition = vec4( transformed, 1.0 );
#ifdef USE_BATCHING
	mvPosition = batchingMatrix * mvPosition;
#endif
#ifdef USE_INSTANCING
	mvPosition = instanceMatrix * mvPosition;
#endif
mvPosition = modelViewMatrix * mvPosition;
gl_Position = projectionMatrix * mvPosition;`,NS=`#ifdef DITHERING
	gl_FragColor.rgb = dithering( gl_FragColor.rgb );
#endif`,DS=`#ifdef DITHERING
	vec3 dithering( vec3 color ) {
		float grid_position = rand( gl_FragCoord.xy );
		vec3 dither_shift_RGB = vec3( 0.25 / 255.0, -0.25 / 255.0, 0.25 / 255.0 );
		dither_shift_RGB = mix( 2.0 * dither_shift_RGB, -2.0 * dither_shift_RGB, grid_position );
		return color + dither_shift_RGB;
	}
#endif`,US=`float roughnessFactor = roughness;
#ifdef USE_ROUGHNESSMAP
	vec4 texelRoughness = texture2D( roughnessMap, vRoughnessMapUv );
	roughnessFactor *= texelRoughness.g;
#endif`,OS=`#ifdef USE_ROUGHNESSMAP
	uniform sampler2D roughnessMap;
#endif`,FS=`#if NUM_SPOT_LIGHT_COORDS > 0
	varying vec4 vSpotLightCoord[ NUM_SPOT_LIGHT_COORDS ];
#endif
#if NUM_SPOT_LIGHT_MAPS > 0
	uniform sampler2D spotLightMap[ NUM_SPOT_LIGHT_MAPS ];
#endif
#ifdef USE_SHADOWMAP
	#if NUM_SUN_LIGHT_SHADOWS > 0
		#define SUN_LIGHT_CASCADES 2
		#if defined( SHADOWMAP_TYPE_PCF )
			uniform sampler2DShadow sunShadowMap[ NUM_SUN_LIGHT_SHADOWS ];
		#else
			uniform sampler2D sunShadowMap[ NUM_SUN_LIGHT_SHADOWS ];
		#endif
		uniform mat4 sunShadowMatrix[ NUM_SUN_LIGHT_SHADOWS * SUN_LIGHT_CASCADES ];
		uniform vec4 sunShadowCascade[ NUM_SUN_LIGHT_SHADOWS * SUN_LIGHT_CASCADES ];
		varying vec4 vSunShadowWorldPosition;
		varying vec3 vSunShadowWorldNormal;
		struct SunLightShadow {
			float shadowIntensity;
			float shadowBias;
			float shadowNormalBias;
			float shadowRadius;
			vec2 shadowMapSize;
		};
		uniform SunLightShadow sunLightShadows[ NUM_SUN_LIGHT_SHADOWS ];
	#endif
	#if NUM_DIR_LIGHT_SHADOWS > 0
		#if defined( SHADOWMAP_TYPE_PCF )
			uniform sampler2DShadow directionalShadowMap[ NUM_DIR_LIGHT_SHADOWS ];
		#else
			uniform sampler2D directionalShadowMap[ NUM_DIR_LIGHT_SHADOWS ];
		#endif
		varying vec4 vDirectionalShadowCoord[ NUM_DIR_LIGHT_SHADOWS ];
		struct DirectionalLightShadow {
			float shadowIntensity;
			float shadowBias;
			float shadowNormalBias;
			float shadowRadius;
			vec2 shadowMapSize;
		};
		uniform DirectionalLightShadow directionalLightShadows[ NUM_DIR_LIGHT_SHADOWS ];
	#endif
	#if NUM_SPOT_LIGHT_SHADOWS > 0
		#if defined( SHADOWMAP_TYPE_PCF )
			uniform sampler2DShadow spotShadowMap[ NUM_SPOT_LIGHT_SHADOWS ];
		#else
			uniform sampler2D spotShadowMap[ NUM_SPOT_LIGHT_SHADOWS ];
		#endif
		struct SpotLightShadow {
			float shadowIntensity;
			float shadowBias;
			float shadowNormalBias;
			float shadowRadius;
			vec2 shadowMapSize;
		};
		uniform SpotLightShadow spotLightShadows[ NUM_SPOT_LIGHT_SHADOWS ];
	#endif
	#if NUM_POINT_LIGHT_SHADOWS > 0
		#if defined( SHADOWMAP_TYPE_PCF )
			uniform samplerCubeShadow pointShadowMap[ NUM_POINT_LIGHT_SHADOWS ];
		#elif defined( SHADOWMAP_TYPE_BASIC )
			uniform samplerCube pointShadowMap[ NUM_POINT_LIGHT_SHADOWS ];
		#endif
		varying vec4 vPointShadowCoord[ NUM_POINT_LIGHT_SHADOWS ];
		struct PointLightShadow {
			float shadowIntensity;
			float shadowBias;
			float shadowNormalBias;
			float shadowRadius;
			vec2 shadowMapSize;
			float shadowCameraNear;
			float shadowCameraFar;
		};
		uniform PointLightShadow pointLightShadows[ NUM_POINT_LIGHT_SHADOWS ];
	#endif
	#if defined( SHADOWMAP_TYPE_PCF )
		float interleavedGradientNoise( vec2 position ) {
			return fract( 52.9829189 * fract( dot( position, vec2( 0.06711056, 0.00583715 ) ) ) );
		}
		vec2 vogelDiskSample( int sampleIndex, int samplesCount, float phi ) {
			const float goldenAngle = 2.399963229728653;
			float r = sqrt( ( float( sampleIndex ) + 0.5 ) / float( samplesCount ) );
			float theta = float( sampleIndex ) * goldenAngle + phi;
			return vec2( cos( theta ), sin( theta ) ) * r;
		}
	#endif
	#if defined( SHADOWMAP_TYPE_PCF )
		float getShadow( sampler2DShadow shadowMap, vec2 shadowMapSize, float shadowIntensity, float shadowBias, float shadowRadius, vec4 shadowCoord ) {
			float shadow = 1.0;
			shadowCoord.xyz /= shadowCoord.w;
			#ifdef USE_REVERSED_DEPTH_BUFFER
				shadowCoord.z -= shadowBias;
			#else
				shadowCoord.z += shadowBias;
			#endif
			bool inFrustum = shadowCoord.x >= 0.0 && shadowCoord.x <= 1.0 && shadowCoord.y >= 0.0 && shadowCoord.y <= 1.0;
			bool frustumTest = inFrustum && shadowCoord.z <= 1.0;
			if ( frustumTest ) {
				vec2 texelSize = vec2( 1.0 ) / shadowMapSize;
				vec2 radius = shadowRadius * texelSize;
				float phi = interleavedGradientNoise( gl_FragCoord.xy ) * PI2;
				shadow = (
					texture( shadowMap, vec3( shadowCoord.xy + vogelDiskSample( 0, 5, phi ) * radius, shadowCoord.z ) ) +
					texture( shadowMap, vec3( shadowCoord.xy + vogelDiskSample( 1, 5, phi ) * radius, shadowCoord.z ) ) +
					texture( shadowMap, vec3( shadowCoord.xy + vogelDiskSample( 2, 5, phi ) * radius, shadowCoord.z ) ) +
					texture( shadowMap, vec3( shadowCoord.xy + vogelDiskSample( 3, 5, phi ) * radius, shadowCoord.z ) ) +
					texture( shadowMap, vec3( shadowCoord.xy + vogelDiskSample( 4, 5, phi ) * radius, shadowCoord.z ) )
				) * 0.2;
			}
			return mix( 1.0, shadow, shadowIntensity );
		}
	#elif defined( SHADOWMAP_TYPE_VSM )
		float getShadow( sampler2D shadowMap, vec2 shadowMapSize, float shadowIntensity, float shadowBias, float shadowRadius, vec4 shadowCoord ) {
			float shadow = 1.0;
			shadowCoord.xyz /= shadowCoord.w;
			#ifdef USE_REVERSED_DEPTH_BUFFER
				shadowCoord.z -= shadowBias;
			#else
				shadowCoord.z += shadowBias;
			#endif
			bool inFrustum = shadowCoord.x >= 0.0 && shadowCoord.x <= 1.0 && shadowCoord.y >= 0.0 && shadowCoord.y <= 1.0;
			bool frustumTest = inFrustum && shadowCoord.z <= 1.0;
			if ( frustumTest ) {
				vec2 distribution = texture2D( shadowMap, shadowCoord.xy ).rg;
				float mean = distribution.x;
				float variance = distribution.y * distribution.y;
				#ifdef USE_REVERSED_DEPTH_BUFFER
					float hard_shadow = step( mean, shadowCoord.z );
				#else
					float hard_shadow = step( shadowCoord.z, mean );
				#endif
				
				if ( hard_shadow == 1.0 ) {
					shadow = 1.0;
				} else {
					variance = max( variance, 0.0000001 );
					float d = shadowCoord.z - mean;
					float p_max = variance / ( variance + d * d );
					p_max = clamp( ( p_max - 0.3 ) / 0.65, 0.0, 1.0 );
					shadow = max( hard_shadow, p_max );
				}
			}
			return mix( 1.0, shadow, shadowIntensity );
		}
	#else
		float getShadow( sampler2D shadowMap, vec2 shadowMapSize, float shadowIntensity, float shadowBias, float shadowRadius, vec4 shadowCoord ) {
			float shadow = 1.0;
			shadowCoord.xyz /= shadowCoord.w;
			#ifdef USE_REVERSED_DEPTH_BUFFER
				shadowCoord.z -= shadowBias;
			#else
				shadowCoord.z += shadowBias;
			#endif
			bool inFrustum = shadowCoord.x >= 0.0 && shadowCoord.x <= 1.0 && shadowCoord.y >= 0.0 && shadowCoord.y <= 1.0;
			bool frustumTest = inFrustum && shadowCoord.z <= 1.0;
			if ( frustumTest ) {
				float depth = texture2D( shadowMap, shadowCoord.xy ).r;
				#ifdef USE_REVERSED_DEPTH_BUFFER
					shadow = step( depth, shadowCoord.z );
				#else
					shadow = step( shadowCoord.z, depth );
				#endif
			}
			return mix( 1.0, shadow, shadowIntensity );
		}
	#endif
	#if NUM_SUN_LIGHT_SHADOWS > 0
		float getSunShadow(
			#if defined( SHADOWMAP_TYPE_PCF )
				sampler2DShadow shadowMap,
			#else
				sampler2D shadowMap,
			#endif
			SunLightShadow sunLightShadow,
			int shadowIndex
		) {
			vec4 shadowWorldPosition = vec4( vSunShadowWorldPosition.xyz + vSunShadowWorldNormal * sunLightShadow.shadowNormalBias, 1.0 );
			float viewDepth = vSunShadowWorldPosition.w;
			int cascadeOffset = shadowIndex * SUN_LIGHT_CASCADES;
			float shadow = 1.0;
			for ( int i = SUN_LIGHT_CASCADES - 1; i >= 0; i -- ) {
				vec4 cascade = sunShadowCascade[ cascadeOffset + i ];
				if ( viewDepth >= cascade.x && viewDepth < cascade.y ) {
					float cascadeShadow = getShadow(
						shadowMap,
						sunLightShadow.shadowMapSize,
						sunLightShadow.shadowIntensity,
						sunLightShadow.shadowBias,
						sunLightShadow.shadowRadius,
						sunShadowMatrix[ cascadeOffset + i ] * shadowWorldPosition
					);
					shadow = mix( cascadeShadow, shadow, smoothstep( cascade.z, cascade.y, viewDepth ) );
				}
			}
			return shadow;
		}
	#endif
	#if NUM_POINT_LIGHT_SHADOWS > 0
	#if defined( SHADOWMAP_TYPE_PCF )
	float getPointShadow( samplerCubeShadow shadowMap, vec2 shadowMapSize, float shadowIntensity, float shadowBias, float shadowRadius, vec4 shadowCoord, float shadowCameraNear, float shadowCameraFar ) {
		float shadow = 1.0;
		vec3 lightToPosition = shadowCoord.xyz;
		vec3 bd3D = normalize( lightToPosition );
		vec3 absVec = abs( lightToPosition );
		float viewSpaceZ = max( max( absVec.x, absVec.y ), absVec.z );
		if ( viewSpaceZ - shadowCameraFar <= 0.0 && viewSpaceZ - shadowCameraNear >= 0.0 ) {
			float lightDistance = length( lightToPosition );
			float depthRange = shadowCameraFar - shadowCameraNear;
			#ifdef USE_REVERSED_DEPTH_BUFFER
				float depthA = - shadowCameraNear / depthRange - shadowBias;
				float depthB = shadowCameraNear * shadowCameraFar / ( depthRange * lightDistance );
			#else
				float depthA = shadowCameraFar / depthRange + shadowBias;
				float depthB = - shadowCameraNear * shadowCameraFar / ( depthRange * lightDistance );
			#endif
			float texelSize = shadowRadius / shadowMapSize.x;
			vec3 absDir = abs( bd3D );
			vec3 tangent = absDir.x > absDir.z ? vec3( 0.0, 1.0, 0.0 ) : vec3( 1.0, 0.0, 0.0 );
			tangent = normalize( cross( bd3D, tangent ) );
			vec3 bitangent = cross( bd3D, tangent );
			float phi = interleavedGradientNoise( gl_FragCoord.xy ) * PI2;
			shadow = 0.0;
			for ( int i = 0; i < 5; i ++ ) {
				vec2 offset = vogelDiskSample( i, 5, phi );
				vec3 direction = bd3D + ( tangent * offset.x + bitangent * offset.y ) * texelSize;
				vec3 absDirection = abs( direction );
				float dp = depthA + depthB / max( max( absDirection.x, absDirection.y ), absDirection.z );
				shadow += texture( shadowMap, vec4( direction, dp ) );
			}
			shadow *= 0.2;
		}
		return mix( 1.0, shadow, shadowIntensity );
	}
	#elif defined( SHADOWMAP_TYPE_BASIC )
	float getPointShadow( samplerCube shadowMap, vec2 shadowMapSize, float shadowIntensity, float shadowBias, float shadowRadius, vec4 shadowCoord, float shadowCameraNear, float shadowCameraFar ) {
		float shadow = 1.0;
		vec3 lightToPosition = shadowCoord.xyz;
		vec3 absVec = abs( lightToPosition );
		float viewSpaceZ = max( max( absVec.x, absVec.y ), absVec.z );
		if ( viewSpaceZ - shadowCameraFar <= 0.0 && viewSpaceZ - shadowCameraNear >= 0.0 ) {
			float dp = ( shadowCameraFar * ( viewSpaceZ - shadowCameraNear ) ) / ( viewSpaceZ * ( shadowCameraFar - shadowCameraNear ) );
			dp += shadowBias;
			vec3 bd3D = normalize( lightToPosition );
			float depth = textureCube( shadowMap, bd3D ).r;
			#ifdef USE_REVERSED_DEPTH_BUFFER
				depth = 1.0 - depth;
			#endif
			shadow = step( dp, depth );
		}
		return mix( 1.0, shadow, shadowIntensity );
	}
	#endif
	#endif
#endif`,BS=`#if NUM_SPOT_LIGHT_COORDS > 0
	uniform mat4 spotLightMatrix[ NUM_SPOT_LIGHT_COORDS ];
	varying vec4 vSpotLightCoord[ NUM_SPOT_LIGHT_COORDS ];
#endif
#ifdef USE_SHADOWMAP
	#if NUM_SUN_LIGHT_SHADOWS > 0
		varying vec4 vSunShadowWorldPosition;
		varying vec3 vSunShadowWorldNormal;
	#endif
	#if NUM_DIR_LIGHT_SHADOWS > 0
		uniform mat4 directionalShadowMatrix[ NUM_DIR_LIGHT_SHADOWS ];
		varying vec4 vDirectionalShadowCoord[ NUM_DIR_LIGHT_SHADOWS ];
		struct DirectionalLightShadow {
			float shadowIntensity;
			float shadowBias;
			float shadowNormalBias;
			float shadowRadius;
			vec2 shadowMapSize;
		};
		uniform DirectionalLightShadow directionalLightShadows[ NUM_DIR_LIGHT_SHADOWS ];
	#endif
	#if NUM_SPOT_LIGHT_SHADOWS > 0
		struct SpotLightShadow {
			float shadowIntensity;
			float shadowBias;
			float shadowNormalBias;
			float shadowRadius;
			vec2 shadowMapSize;
		};
		uniform SpotLightShadow spotLightShadows[ NUM_SPOT_LIGHT_SHADOWS ];
	#endif
	#if NUM_POINT_LIGHT_SHADOWS > 0
		uniform mat4 pointShadowMatrix[ NUM_POINT_LIGHT_SHADOWS ];
		varying vec4 vPointShadowCoord[ NUM_POINT_LIGHT_SHADOWS ];
		struct PointLightShadow {
			float shadowIntensity;
			float shadowBias;
			float shadowNormalBias;
			float shadowRadius;
			vec2 shadowMapSize;
			float shadowCameraNear;
			float shadowCameraFar;
		};
		uniform PointLightShadow pointLightShadows[ NUM_POINT_LIGHT_SHADOWS ];
	#endif
#endif`,kS=`#if ( defined( USE_SHADOWMAP ) && ( NUM_DIR_LIGHT_SHADOWS > 0 || NUM_SUN_LIGHT_SHADOWS > 0 || NUM_POINT_LIGHT_SHADOWS > 0 ) ) || ( NUM_SPOT_LIGHT_COORDS > 0 )
	#ifdef HAS_NORMAL
		vec3 shadowWorldNormal = transformNormalByInverseViewMatrix( transformedNormal, viewMatrix );
	#else
		vec3 shadowWorldNormal = vec3( 0.0 );
	#endif
	vec4 shadowWorldPosition;
#endif
#if defined( USE_SHADOWMAP )
	#if NUM_SUN_LIGHT_SHADOWS > 0
		vSunShadowWorldPosition = vec4( worldPosition.xyz, - mvPosition.z );
		vSunShadowWorldNormal = shadowWorldNormal;
	#endif
	#if NUM_DIR_LIGHT_SHADOWS > 0
		#pragma unroll_loop_start
		for ( int i = 0; i < NUM_DIR_LIGHT_SHADOWS; i ++ ) {
			shadowWorldPosition = worldPosition + vec4( shadowWorldNormal * directionalLightShadows[ i ].shadowNormalBias, 0 );
			vDirectionalShadowCoord[ i ] = directionalShadowMatrix[ i ] * shadowWorldPosition;
		}
		#pragma unroll_loop_end
	#endif
	#if NUM_POINT_LIGHT_SHADOWS > 0
		#pragma unroll_loop_start
		for ( int i = 0; i < NUM_POINT_LIGHT_SHADOWS; i ++ ) {
			shadowWorldPosition = worldPosition + vec4( shadowWorldNormal * pointLightShadows[ i ].shadowNormalBias, 0 );
			vPointShadowCoord[ i ] = pointShadowMatrix[ i ] * shadowWorldPosition;
		}
		#pragma unroll_loop_end
	#endif
#endif
#if NUM_SPOT_LIGHT_COORDS > 0
	#pragma unroll_loop_start
	for ( int i = 0; i < NUM_SPOT_LIGHT_COORDS; i ++ ) {
		shadowWorldPosition = worldPosition;
		#if ( defined( USE_SHADOWMAP ) && UNROLLED_LOOP_INDEX < NUM_SPOT_LIGHT_SHADOWS )
			shadowWorldPosition.xyz += shadowWorldNormal * spotLightShadows[ i ].shadowNormalBias;
		#endif
		vSpotLightCoord[ i ] = spotLightMatrix[ i ] * shadowWorldPosition;
	}
	#pragma unroll_loop_end
#endif`,zS=`float getShadowMask() {
	float shadow = 1.0;
	#ifdef USE_SHADOWMAP
	#if NUM_SUN_LIGHT_SHADOWS > 0
	SunLightShadow sunLight;
	#pragma unroll_loop_start
	for ( int i = 0; i < NUM_SUN_LIGHT_SHADOWS; i ++ ) {
		sunLight = sunLightShadows[ i ];
		shadow *= receiveShadow ? getSunShadow( sunShadowMap[ i ], sunLight, UNROLLED_LOOP_INDEX ) : 1.0;
	}
	#pragma unroll_loop_end
	#endif
	#if NUM_DIR_LIGHT_SHADOWS > 0
	DirectionalLightShadow directionalLight;
	#pragma unroll_loop_start
	for ( int i = 0; i < NUM_DIR_LIGHT_SHADOWS; i ++ ) {
		directionalLight = directionalLightShadows[ i ];
		shadow *= receiveShadow ? getShadow( directionalShadowMap[ i ], directionalLight.shadowMapSize, directionalLight.shadowIntensity, directionalLight.shadowBias, directionalLight.shadowRadius, vDirectionalShadowCoord[ i ] ) : 1.0;
	}
	#pragma unroll_loop_end
	#endif
	#if NUM_SPOT_LIGHT_SHADOWS > 0
	SpotLightShadow spotLight;
	#pragma unroll_loop_start
	for ( int i = 0; i < NUM_SPOT_LIGHT_SHADOWS; i ++ ) {
		spotLight = spotLightShadows[ i ];
		shadow *= receiveShadow ? getShadow( spotShadowMap[ i ], spotLight.shadowMapSize, spotLight.shadowIntensity, spotLight.shadowBias, spotLight.shadowRadius, vSpotLightCoord[ i ] ) : 1.0;
	}
	#pragma unroll_loop_end
	#endif
	#if NUM_POINT_LIGHT_SHADOWS > 0 && ( defined( SHADOWMAP_TYPE_PCF ) || defined( SHADOWMAP_TYPE_BASIC ) )
	PointLightShadow pointLight;
	#pragma unroll_loop_start
	for ( int i = 0; i < NUM_POINT_LIGHT_SHADOWS; i ++ ) {
		pointLight = pointLightShadows[ i ];
		shadow *= receiveShadow ? getPointShadow( pointShadowMap[ i ], pointLight.shadowMapSize, pointLight.shadowIntensity, pointLight.shadowBias, pointLight.shadowRadius, vPointShadowCoord[ i ], pointLight.shadowCameraNear, pointLight.shadowCameraFar ) : 1.0;
	}
	#pragma unroll_loop_end
	#endif
	#endif
	return shadow;
}`,VS=`#ifdef USE_SKINNING
	mat4 boneMatX = getBoneMatrix( skinIndex.x );
	mat4 boneMatY = getBoneMatrix( skinIndex.y );
	mat4 boneMatZ = getBoneMatrix( skinIndex.z );
	mat4 boneMatW = getBoneMatrix( skinIndex.w );
#endif`,GS=`#ifdef USE_SKINNING
	uniform mat4 bindMatrix;
	uniform mat4 bindMatrixInverse;
	uniform highp sampler2D boneTexture;
	mat4 getBoneMatrix( const in float i ) {
		int size = textureSize( boneTexture, 0 ).x;
		int j = int( i ) * 4;
		int x = j % size;
		int y = j / size;
		vec4 v1 = texelFetch( boneTexture, ivec2( x, y ), 0 );
		vec4 v2 = texelFetch( boneTexture, ivec2( x + 1, y ), 0 );
		vec4 v3 = texelFetch( boneTexture, ivec2( x + 2, y ), 0 );
		vec4 v4 = texelFetch( boneTexture, ivec2( x + 3, y ), 0 );
		return mat4( v1, v2, v3, v4 );
	}
#endif`,HS=`#ifdef USE_SKINNING
	vec4 skinVertex = bindMatrix * vec4( transformed, 1.0 );
	vec4 skinned = vec4( 0.0 );
	skinned += boneMatX * skinVertex * skinWeight.x;
	skinned += boneMatY * skinVertex * skinWeight.y;
	skinned += boneMatZ * skinVertex * skinWeight.z;
	skinned += boneMatW * skinVertex * skinWeight.w;
	transformed = ( bindMatrixInverse * skinned ).xyz;
#endif`,WS=`#ifdef USE_SKINNING
	mat4 skinMatrix = mat4( 0.0 );
	skinMatrix += skinWeight.x * boneMatX;
	skinMatrix += skinWeight.y * boneMatY;
	skinMatrix += skinWeight.z * boneMatZ;
	skinMatrix += skinWeight.w * boneMatW;
	skinMatrix = bindMatrixInverse * skinMatrix * bindMatrix;
	objectNormal = vec4( skinMatrix * vec4( objectNormal, 0.0 ) ).xyz;
	#ifdef USE_TANGENT
		objectTangent = vec4( skinMatrix * vec4( objectTangent, 0.0 ) ).xyz;
	#endif
#endif`,XS=`float specularStrength;
#ifdef USE_SPECULARMAP
	vec4 texelSpecular = texture2D( specularMap, vSpecularMapUv );
	specularStrength = texelSpecular.r;
#else
	specularStrength = 1.0;
#endif`,$S=`#ifdef USE_SPECULARMAP
	uniform sampler2D specularMap;
#endif`,qS=`#if defined( TONE_MAPPING )
	gl_FragColor.rgb = toneMapping( gl_FragColor.rgb );
#endif`,YS=`#ifndef saturate
#define saturate( a ) clamp( a, 0.0, 1.0 )
#endif
uniform float toneMappingExposure;
vec3 LinearToneMapping( vec3 color ) {
	return saturate( toneMappingExposure * color );
}
vec3 ReinhardToneMapping( vec3 color ) {
	color *= toneMappingExposure;
	return saturate( color / ( vec3( 1.0 ) + color ) );
}
vec3 CineonToneMapping( vec3 color ) {
	color *= toneMappingExposure;
	color = max( vec3( 0.0 ), color - 0.004 );
	return pow( ( color * ( 6.2 * color + 0.5 ) ) / ( color * ( 6.2 * color + 1.7 ) + 0.06 ), vec3( 2.2 ) );
}
vec3 RRTAndODTFit( vec3 v ) {
	vec3 a = v * ( v + 0.0245786 ) - 0.000090537;
	vec3 b = v * ( 0.983729 * v + 0.4329510 ) + 0.238081;
	return a / b;
}
vec3 ACESFilmicToneMapping( vec3 color ) {
	const mat3 ACESInputMat = mat3(
		vec3( 0.59719, 0.07600, 0.02840 ),		vec3( 0.35458, 0.90834, 0.13383 ),
		vec3( 0.04823, 0.01566, 0.83777 )
	);
	const mat3 ACESOutputMat = mat3(
		vec3(  1.60475, -0.10208, -0.00327 ),		vec3( -0.53108,  1.10813, -0.07276 ),
		vec3( -0.07367, -0.00605,  1.07602 )
	);
	color *= toneMappingExposure / 0.6;
	color = ACESInputMat * color;
	color = RRTAndODTFit( color );
	color = ACESOutputMat * color;
	return saturate( color );
}
const mat3 LINEAR_REC2020_TO_LINEAR_SRGB = mat3(
	vec3( 1.6605, - 0.1246, - 0.0182 ),
	vec3( - 0.5876, 1.1329, - 0.1006 ),
	vec3( - 0.0728, - 0.0083, 1.1187 )
);
const mat3 LINEAR_SRGB_TO_LINEAR_REC2020 = mat3(
	vec3( 0.6274, 0.0691, 0.0164 ),
	vec3( 0.3293, 0.9195, 0.0880 ),
	vec3( 0.0433, 0.0113, 0.8956 )
);
vec3 agxDefaultContrastApprox( vec3 x ) {
	vec3 x2 = x * x;
	vec3 x4 = x2 * x2;
	return + 15.5 * x4 * x2
		- 40.14 * x4 * x
		+ 31.96 * x4
		- 6.868 * x2 * x
		+ 0.4298 * x2
		+ 0.1191 * x
		- 0.00232;
}
vec3 AgXToneMapping( vec3 color ) {
	const mat3 AgXInsetMatrix = mat3(
		vec3( 0.856627153315983, 0.137318972929847, 0.11189821299995 ),
		vec3( 0.0951212405381588, 0.761241990602591, 0.0767994186031903 ),
		vec3( 0.0482516061458583, 0.101439036467562, 0.811302368396859 )
	);
	const mat3 AgXOutsetMatrix = mat3(
		vec3( 1.1271005818144368, - 0.1413297634984383, - 0.14132976349843826 ),
		vec3( - 0.11060664309660323, 1.157823702216272, - 0.11060664309660294 ),
		vec3( - 0.016493938717834573, - 0.016493938717834257, 1.2519364065950405 )
	);
	const float AgxMinEv = - 12.47393;	const float AgxMaxEv = 4.026069;
	color *= toneMappingExposure;
	color = LINEAR_SRGB_TO_LINEAR_REC2020 * color;
	color = AgXInsetMatrix * color;
	color = max( color, 1e-10 );	color = log2( color );
	color = ( color - AgxMinEv ) / ( AgxMaxEv - AgxMinEv );
	color = clamp( color, 0.0, 1.0 );
	color = agxDefaultContrastApprox( color );
	color = AgXOutsetMatrix * color;
	color = pow( max( vec3( 0.0 ), color ), vec3( 2.2 ) );
	color = LINEAR_REC2020_TO_LINEAR_SRGB * color;
	color = clamp( color, 0.0, 1.0 );
	return color;
}
vec3 NeutralToneMapping( vec3 color ) {
	const float StartCompression = 0.8 - 0.04;
	const float Desaturation = 0.15;
	color *= toneMappingExposure;
	float x = min( color.r, min( color.g, color.b ) );
	float offset = x < 0.08 ? x - 6.25 * x * x : 0.04;
	color -= offset;
	float peak = max( color.r, max( color.g, color.b ) );
	if ( peak < StartCompression ) return color;
	float d = 1. - StartCompression;
	float newPeak = 1. - d * d / ( peak + d - StartCompression );
	color *= newPeak / peak;
	float g = 1. - 1. / ( Desaturation * ( peak - newPeak ) + 1. );
	return mix( color, vec3( newPeak ), g );
}
vec3 CustomToneMapping( vec3 color ) { return color; }`,ZS=`#ifdef USE_TRANSMISSION
	material.transmission = transmission;
	material.transmissionAlpha = 1.0;
	material.thickness = thickness;
	material.attenuationDistance = attenuationDistance;
	material.attenuationColor = attenuationColor;
	#ifdef USE_TRANSMISSIONMAP
		material.transmission *= texture2D( transmissionMap, vTransmissionMapUv ).r;
	#endif
	#ifdef USE_THICKNESSMAP
		material.thickness *= texture2D( thicknessMap, vThicknessMapUv ).g;
	#endif
	vec3 pos = vWorldPosition;
	vec3 v = normalize( cameraPosition - pos );
	vec3 n = transformNormalByInverseViewMatrix( normal, viewMatrix );
	vec4 transmitted = getIBLVolumeRefraction(
		n, v, material.roughness, material.diffuseContribution, material.specularColorBlended, material.specularF90,
		pos, modelMatrix, viewMatrix, projectionMatrix, material.dispersion, material.ior, material.thickness,
		material.attenuationColor, material.attenuationDistance );
	material.transmissionAlpha = mix( material.transmissionAlpha, transmitted.a, material.transmission );
	totalDiffuse = mix( totalDiffuse, transmitted.rgb, material.transmission );
#endif`,JS=`#ifdef USE_TRANSMISSION
	uniform float transmission;
	uniform float thickness;
	uniform float attenuationDistance;
	uniform vec3 attenuationColor;
	#ifdef USE_TRANSMISSIONMAP
		uniform sampler2D transmissionMap;
	#endif
	#ifdef USE_THICKNESSMAP
		uniform sampler2D thicknessMap;
	#endif
	uniform vec2 transmissionSamplerSize;
	uniform sampler2D transmissionSamplerMap;
	uniform mat4 modelMatrix;
	uniform mat4 projectionMatrix;
	varying vec3 vWorldPosition;
	float w0( float a ) {
		return ( 1.0 / 6.0 ) * ( a * ( a * ( - a + 3.0 ) - 3.0 ) + 1.0 );
	}
	float w1( float a ) {
		return ( 1.0 / 6.0 ) * ( a *  a * ( 3.0 * a - 6.0 ) + 4.0 );
	}
	float w2( float a ){
		return ( 1.0 / 6.0 ) * ( a * ( a * ( - 3.0 * a + 3.0 ) + 3.0 ) + 1.0 );
	}
	float w3( float a ) {
		return ( 1.0 / 6.0 ) * ( a * a * a );
	}
	float g0( float a ) {
		return w0( a ) + w1( a );
	}
	float g1( float a ) {
		return w2( a ) + w3( a );
	}
	float h0( float a ) {
		return - 1.0 + w1( a ) / ( w0( a ) + w1( a ) );
	}
	float h1( float a ) {
		return 1.0 + w3( a ) / ( w2( a ) + w3( a ) );
	}
	vec4 bicubic( sampler2D tex, vec2 uv, vec4 texelSize, float lod ) {
		uv = uv * texelSize.zw + 0.5;
		vec2 iuv = floor( uv );
		vec2 fuv = fract( uv );
		float g0x = g0( fuv.x );
		float g1x = g1( fuv.x );
		float h0x = h0( fuv.x );
		float h1x = h1( fuv.x );
		float h0y = h0( fuv.y );
		float h1y = h1( fuv.y );
		vec2 p0 = ( vec2( iuv.x + h0x, iuv.y + h0y ) - 0.5 ) * texelSize.xy;
		vec2 p1 = ( vec2( iuv.x + h1x, iuv.y + h0y ) - 0.5 ) * texelSize.xy;
		vec2 p2 = ( vec2( iuv.x + h0x, iuv.y + h1y ) - 0.5 ) * texelSize.xy;
		vec2 p3 = ( vec2( iuv.x + h1x, iuv.y + h1y ) - 0.5 ) * texelSize.xy;
		return g0( fuv.y ) * ( g0x * textureLod( tex, p0, lod ) + g1x * textureLod( tex, p1, lod ) ) +
			g1( fuv.y ) * ( g0x * textureLod( tex, p2, lod ) + g1x * textureLod( tex, p3, lod ) );
	}
	vec4 textureBicubic( sampler2D sampler, vec2 uv, float lod ) {
		vec2 fLodSize = vec2( textureSize( sampler, int( lod ) ) );
		vec2 cLodSize = vec2( textureSize( sampler, int( lod + 1.0 ) ) );
		vec2 fLodSizeInv = 1.0 / fLodSize;
		vec2 cLodSizeInv = 1.0 / cLodSize;
		vec4 fSample = bicubic( sampler, uv, vec4( fLodSizeInv, fLodSize ), floor( lod ) );
		vec4 cSample = bicubic( sampler, uv, vec4( cLodSizeInv, cLodSize ), ceil( lod ) );
		return mix( fSample, cSample, fract( lod ) );
	}
	vec3 getVolumeTransmissionRay( const in vec3 n, const in vec3 v, const in float thickness, const in float ior, const in mat4 modelMatrix ) {
		vec3 refractionVector = refract( - v, normalize( n ), 1.0 / ior );
		vec3 modelScale;
		modelScale.x = length( vec3( modelMatrix[ 0 ].xyz ) );
		modelScale.y = length( vec3( modelMatrix[ 1 ].xyz ) );
		modelScale.z = length( vec3( modelMatrix[ 2 ].xyz ) );
		return normalize( refractionVector ) * thickness * modelScale;
	}
	float applyIorToRoughness( const in float roughness, const in float ior ) {
		return roughness * clamp( ior * 2.0 - 2.0, 0.0, 1.0 );
	}
	vec4 getTransmissionSample( const in vec2 fragCoord, const in float roughness, const in float ior ) {
		float lod = log2( transmissionSamplerSize.x ) * applyIorToRoughness( roughness, ior );
		return textureBicubic( transmissionSamplerMap, fragCoord.xy, lod );
	}
	vec3 volumeAttenuation( const in float transmissionDistance, const in vec3 attenuationColor, const in float attenuationDistance ) {
		if ( isinf( attenuationDistance ) ) {
			return vec3( 1.0 );
		} else {
			vec3 attenuationCoefficient = -log( attenuationColor ) / attenuationDistance;
			vec3 transmittance = exp( - attenuationCoefficient * transmissionDistance );			return transmittance;
		}
	}
	vec4 getIBLVolumeRefraction( const in vec3 n, const in vec3 v, const in float roughness, const in vec3 diffuseColor,
		const in vec3 specularColor, const in float specularF90, const in vec3 position, const in mat4 modelMatrix,
		const in mat4 viewMatrix, const in mat4 projMatrix, const in float dispersion, const in float ior, const in float thickness,
		const in vec3 attenuationColor, const in float attenuationDistance ) {
		vec4 transmittedLight;
		vec3 transmittance;
		#ifdef USE_DISPERSION
			float halfSpread = ( ior - 1.0 ) * 0.025 * dispersion;
			vec3 iors = vec3( ior - halfSpread, ior, ior + halfSpread );
			for ( int i = 0; i < 3; i ++ ) {
				vec3 transmissionRay = getVolumeTransmissionRay( n, v, thickness, iors[ i ], modelMatrix );
				vec3 refractedRayExit = position + transmissionRay;
				vec4 ndcPos = projMatrix * viewMatrix * vec4( refractedRayExit, 1.0 );
				vec2 refractionCoords = ndcPos.xy / ndcPos.w;
				refractionCoords += 1.0;
				refractionCoords /= 2.0;
				vec4 transmissionSample = getTransmissionSample( refractionCoords, roughness, iors[ i ] );
				transmittedLight[ i ] = transmissionSample[ i ];
				transmittedLight.a += transmissionSample.a;
				transmittance[ i ] = diffuseColor[ i ] * volumeAttenuation( length( transmissionRay ), attenuationColor, attenuationDistance )[ i ];
			}
			transmittedLight.a /= 3.0;
		#else
			vec3 transmissionRay = getVolumeTransmissionRay( n, v, thickness, ior, modelMatrix );
			vec3 refractedRayExit = position + transmissionRay;
			vec4 ndcPos = projMatrix * viewMatrix * vec4( refractedRayExit, 1.0 );
			vec2 refractionCoords = ndcPos.xy / ndcPos.w;
			refractionCoords += 1.0;
			refractionCoords /= 2.0;
			transmittedLight = getTransmissionSample( refractionCoords, roughness, ior );
			transmittance = diffuseColor * volumeAttenuation( length( transmissionRay ), attenuationColor, attenuationDistance );
		#endif
		vec3 attenuatedColor = transmittance * transmittedLight.rgb;
		vec3 F = EnvironmentBRDF( n, v, specularColor, specularF90, roughness );
		float transmittanceFactor = ( transmittance.r + transmittance.g + transmittance.b ) / 3.0;
		return vec4( ( 1.0 - F ) * attenuatedColor, 1.0 - ( 1.0 - transmittedLight.a ) * transmittanceFactor );
	}
#endif`,jS=`#if defined( USE_UV ) || defined( USE_ANISOTROPY )
	varying vec2 vUv;
#endif
#ifdef USE_MAP
	varying vec2 vMapUv;
#endif
#ifdef USE_ALPHAMAP
	varying vec2 vAlphaMapUv;
#endif
#ifdef USE_LIGHTMAP
	varying vec2 vLightMapUv;
#endif
#ifdef USE_AOMAP
	varying vec2 vAoMapUv;
#endif
#ifdef USE_BUMPMAP
	varying vec2 vBumpMapUv;
#endif
#ifdef USE_NORMALMAP
	varying vec2 vNormalMapUv;
#endif
#ifdef USE_EMISSIVEMAP
	varying vec2 vEmissiveMapUv;
#endif
#ifdef USE_METALNESSMAP
	varying vec2 vMetalnessMapUv;
#endif
#ifdef USE_ROUGHNESSMAP
	varying vec2 vRoughnessMapUv;
#endif
#ifdef USE_DIFFUSE_ROUGHNESSMAP
	varying vec2 vDiffuseRoughnessMapUv;
#endif
#ifdef USE_ANISOTROPYMAP
	varying vec2 vAnisotropyMapUv;
#endif
#ifdef USE_CLEARCOATMAP
	varying vec2 vClearcoatMapUv;
#endif
#ifdef USE_CLEARCOAT_NORMALMAP
	varying vec2 vClearcoatNormalMapUv;
#endif
#ifdef USE_CLEARCOAT_ROUGHNESSMAP
	varying vec2 vClearcoatRoughnessMapUv;
#endif
#ifdef USE_IRIDESCENCEMAP
	varying vec2 vIridescenceMapUv;
#endif
#ifdef USE_IRIDESCENCE_THICKNESSMAP
	varying vec2 vIridescenceThicknessMapUv;
#endif
#ifdef USE_SHEEN_COLORMAP
	varying vec2 vSheenColorMapUv;
#endif
#ifdef USE_SHEEN_ROUGHNESSMAP
	varying vec2 vSheenRoughnessMapUv;
#endif
#ifdef USE_SPECULARMAP
	varying vec2 vSpecularMapUv;
#endif
#ifdef USE_SPECULAR_COLORMAP
	varying vec2 vSpecularColorMapUv;
#endif
#ifdef USE_SPECULAR_INTENSITYMAP
	varying vec2 vSpecularIntensityMapUv;
#endif
#ifdef USE_TRANSMISSIONMAP
	uniform mat3 transmissionMapTransform;
	varying vec2 vTransmissionMapUv;
#endif
#ifdef USE_THICKNESSMAP
	uniform mat3 thicknessMapTransform;
	varying vec2 vThicknessMapUv;
#endif`,KS=`#if defined( USE_UV ) || defined( USE_ANISOTROPY )
	varying vec2 vUv;
#endif
#ifdef USE_MAP
	uniform mat3 mapTransform;
	varying vec2 vMapUv;
#endif
#ifdef USE_ALPHAMAP
	uniform mat3 alphaMapTransform;
	varying vec2 vAlphaMapUv;
#endif
#ifdef USE_LIGHTMAP
	uniform mat3 lightMapTransform;
	varying vec2 vLightMapUv;
#endif
#ifdef USE_AOMAP
	uniform mat3 aoMapTransform;
	varying vec2 vAoMapUv;
#endif
#ifdef USE_BUMPMAP
	uniform mat3 bumpMapTransform;
	varying vec2 vBumpMapUv;
#endif
#ifdef USE_NORMALMAP
	uniform mat3 normalMapTransform;
	varying vec2 vNormalMapUv;
#endif
#ifdef USE_DISPLACEMENTMAP
	uniform mat3 displacementMapTransform;
	varying vec2 vDisplacementMapUv;
#endif
#ifdef USE_EMISSIVEMAP
	uniform mat3 emissiveMapTransform;
	varying vec2 vEmissiveMapUv;
#endif
#ifdef USE_METALNESSMAP
	uniform mat3 metalnessMapTransform;
	varying vec2 vMetalnessMapUv;
#endif
#ifdef USE_ROUGHNESSMAP
	uniform mat3 roughnessMapTransform;
	varying vec2 vRoughnessMapUv;
#endif
#ifdef USE_DIFFUSE_ROUGHNESSMAP
	uniform mat3 diffuseRoughnessMapTransform;
	varying vec2 vDiffuseRoughnessMapUv;
#endif
#ifdef USE_ANISOTROPYMAP
	uniform mat3 anisotropyMapTransform;
	varying vec2 vAnisotropyMapUv;
#endif
#ifdef USE_CLEARCOATMAP
	uniform mat3 clearcoatMapTransform;
	varying vec2 vClearcoatMapUv;
#endif
#ifdef USE_CLEARCOAT_NORMALMAP
	uniform mat3 clearcoatNormalMapTransform;
	varying vec2 vClearcoatNormalMapUv;
#endif
#ifdef USE_CLEARCOAT_ROUGHNESSMAP
	uniform mat3 clearcoatRoughnessMapTransform;
	varying vec2 vClearcoatRoughnessMapUv;
#endif
#ifdef USE_SHEEN_COLORMAP
	uniform mat3 sheenColorMapTransform;
	varying vec2 vSheenColorMapUv;
#endif
#ifdef USE_SHEEN_ROUGHNESSMAP
	uniform mat3 sheenRoughnessMapTransform;
	varying vec2 vSheenRoughnessMapUv;
#endif
#ifdef USE_IRIDESCENCEMAP
	uniform mat3 iridescenceMapTransform;
	varying vec2 vIridescenceMapUv;
#endif
#ifdef USE_IRIDESCENCE_THICKNESSMAP
	uniform mat3 iridescenceThicknessMapTransform;
	varying vec2 vIridescenceThicknessMapUv;
#endif
#ifdef USE_SPECULARMAP
	uniform mat3 specularMapTransform;
	varying vec2 vSpecularMapUv;
#endif
#ifdef USE_SPECULAR_COLORMAP
	uniform mat3 specularColorMapTransform;
	varying vec2 vSpecularColorMapUv;
#endif
#ifdef USE_SPECULAR_INTENSITYMAP
	uniform mat3 specularIntensityMapTransform;
	varying vec2 vSpecularIntensityMapUv;
#endif
#ifdef USE_TRANSMISSIONMAP
	uniform mat3 transmissionMapTransform;
	varying vec2 vTransmissionMapUv;
#endif
#ifdef USE_THICKNESSMAP
	uniform mat3 thicknessMapTransform;
	varying vec2 vThicknessMapUv;
#endif`,QS=`#if defined( USE_UV ) || defined( USE_ANISOTROPY )
	vUv = vec3( uv, 1 ).xy;
#endif
#ifdef USE_MAP
	vMapUv = ( mapTransform * vec3( MAP_UV, 1 ) ).xy;
#endif
#ifdef USE_ALPHAMAP
	vAlphaMapUv = ( alphaMapTransform * vec3( ALPHAMAP_UV, 1 ) ).xy;
#endif
#ifdef USE_LIGHTMAP
	vLightMapUv = ( lightMapTransform * vec3( LIGHTMAP_UV, 1 ) ).xy;
#endif
#ifdef USE_AOMAP
	vAoMapUv = ( aoMapTransform * vec3( AOMAP_UV, 1 ) ).xy;
#endif
#ifdef USE_BUMPMAP
	vBumpMapUv = ( bumpMapTransform * vec3( BUMPMAP_UV, 1 ) ).xy;
#endif
#ifdef USE_NORMALMAP
	vNormalMapUv = ( normalMapTransform * vec3( NORMALMAP_UV, 1 ) ).xy;
#endif
#ifdef USE_DISPLACEMENTMAP
	vDisplacementMapUv = ( displacementMapTransform * vec3( DISPLACEMENTMAP_UV, 1 ) ).xy;
#endif
#ifdef USE_EMISSIVEMAP
	vEmissiveMapUv = ( emissiveMapTransform * vec3( EMISSIVEMAP_UV, 1 ) ).xy;
#endif
#ifdef USE_METALNESSMAP
	vMetalnessMapUv = ( metalnessMapTransform * vec3( METALNESSMAP_UV, 1 ) ).xy;
#endif
#ifdef USE_ROUGHNESSMAP
	vRoughnessMapUv = ( roughnessMapTransform * vec3( ROUGHNESSMAP_UV, 1 ) ).xy;
#endif
#ifdef USE_DIFFUSE_ROUGHNESSMAP
	vDiffuseRoughnessMapUv = ( diffuseRoughnessMapTransform * vec3( DIFFUSE_ROUGHNESSMAP_UV, 1 ) ).xy;
#endif
#ifdef USE_ANISOTROPYMAP
	vAnisotropyMapUv = ( anisotropyMapTransform * vec3( ANISOTROPYMAP_UV, 1 ) ).xy;
#endif
#ifdef USE_CLEARCOATMAP
	vClearcoatMapUv = ( clearcoatMapTransform * vec3( CLEARCOATMAP_UV, 1 ) ).xy;
#endif
#ifdef USE_CLEARCOAT_NORMALMAP
	vClearcoatNormalMapUv = ( clearcoatNormalMapTransform * vec3( CLEARCOAT_NORMALMAP_UV, 1 ) ).xy;
#endif
#ifdef USE_CLEARCOAT_ROUGHNESSMAP
	vClearcoatRoughnessMapUv = ( clearcoatRoughnessMapTransform * vec3( CLEARCOAT_ROUGHNESSMAP_UV, 1 ) ).xy;
#endif
#ifdef USE_IRIDESCENCEMAP
	vIridescenceMapUv = ( iridescenceMapTransform * vec3( IRIDESCENCEMAP_UV, 1 ) ).xy;
#endif
#ifdef USE_IRIDESCENCE_THICKNESSMAP
	vIridescenceThicknessMapUv = ( iridescenceThicknessMapTransform * vec3( IRIDESCENCE_THICKNESSMAP_UV, 1 ) ).xy;
#endif
#ifdef USE_SHEEN_COLORMAP
	vSheenColorMapUv = ( sheenColorMapTransform * vec3( SHEEN_COLORMAP_UV, 1 ) ).xy;
#endif
#ifdef USE_SHEEN_ROUGHNESSMAP
	vSheenRoughnessMapUv = ( sheenRoughnessMapTransform * vec3( SHEEN_ROUGHNESSMAP_UV, 1 ) ).xy;
#endif
#ifdef USE_SPECULARMAP
	vSpecularMapUv = ( specularMapTransform * vec3( SPECULARMAP_UV, 1 ) ).xy;
#endif
#ifdef USE_SPECULAR_COLORMAP
	vSpecularColorMapUv = ( specularColorMapTransform * vec3( SPECULAR_COLORMAP_UV, 1 ) ).xy;
#endif
#ifdef USE_SPECULAR_INTENSITYMAP
	vSpecularIntensityMapUv = ( specularIntensityMapTransform * vec3( SPECULAR_INTENSITYMAP_UV, 1 ) ).xy;
#endif
#ifdef USE_TRANSMISSIONMAP
	vTransmissionMapUv = ( transmissionMapTransform * vec3( TRANSMISSIONMAP_UV, 1 ) ).xy;
#endif
#ifdef USE_THICKNESSMAP
	vThicknessMapUv = ( thicknessMapTransform * vec3( THICKNESSMAP_UV, 1 ) ).xy;
#endif`,tw=`#if defined( USE_ENVMAP ) || defined( DISTANCE ) || defined ( USE_SHADOWMAP ) || defined ( USE_TRANSMISSION ) || NUM_SPOT_LIGHT_COORDS > 0
	vec4 worldPosition = vec4( transformed, 1.0 );
	#ifdef USE_BATCHING
		worldPosition = batchingMatrix * worldPosition;
	#endif
	#ifdef USE_INSTANCING
		worldPosition = instanceMatrix * worldPosition;
	#endif
	worldPosition = modelMatrix * worldPosition;
#endif`,ew=`varying vec2 vUv;
uniform mat3 uvTransform;
void main() {
	vUv = ( uvTransform * vec3( uv, 1 ) ).xy;
	gl_Position = vec4( position.xy, 1.0, 1.0 );
}`,nw=`uniform sampler2D t2D;
uniform float backgroundIntensity;
varying vec2 vUv;
void main() {
	vec4 texColor = texture2D( t2D, vUv );
	#ifdef DECODE_VIDEO_TEXTURE
		texColor = vec4( mix( pow( texColor.rgb * 0.9478672986 + vec3( 0.0521327014 ), vec3( 2.4 ) ), texColor.rgb * 0.0773993808, vec3( lessThanEqual( texColor.rgb, vec3( 0.04045 ) ) ) ), texColor.w );
	#endif
	texColor.rgb *= backgroundIntensity;
	gl_FragColor = texColor;
	#include <tonemapping_fragment>
	#include <colorspace_fragment>
}`,iw=`varying vec3 vWorldDirection;
#include <common>
void main() {
	vWorldDirection = transformDirection( position, modelMatrix );
	#include <begin_vertex>
	#include <project_vertex>
	gl_Position.z = gl_Position.w;
}`,sw=`uniform float backgroundBlurriness;
uniform float backgroundIntensity;
uniform mat3 backgroundRotation;
varying vec3 vWorldDirection;
#include <envmap_common_pars_fragment>
void main() {
	#ifdef ENVMAP_TYPE_PMREM
		vec4 texColor = textureLod( envMap, backgroundRotation * vWorldDirection, roughnessToMip( backgroundBlurriness ) );
	#else
		vec4 texColor = textureCube( envMap, backgroundRotation * vWorldDirection );
	#endif
	texColor.rgb *= backgroundIntensity;
	gl_FragColor = texColor;
	#include <tonemapping_fragment>
	#include <colorspace_fragment>
}`,rw=`varying vec3 vWorldDirection;
#include <common>
void main() {
	vWorldDirection = transformDirection( position, modelMatrix );
	#include <begin_vertex>
	#include <project_vertex>
	gl_Position.z = gl_Position.w;
}`,ow=`uniform samplerCube tCube;
uniform float tFlip;
uniform float opacity;
varying vec3 vWorldDirection;
void main() {
	vec4 texColor = textureCube( tCube, vec3( tFlip * vWorldDirection.x, vWorldDirection.yz ) );
	gl_FragColor = texColor;
	gl_FragColor.a *= opacity;
	#include <tonemapping_fragment>
	#include <colorspace_fragment>
}`,aw=`#include <common>
#include <batching_pars_vertex>
#include <uv_pars_vertex>
#include <displacementmap_pars_vertex>
#include <morphtarget_pars_vertex>
#include <skinning_pars_vertex>
#include <logdepthbuf_pars_vertex>
#include <clipping_planes_pars_vertex>
varying vec2 vHighPrecisionZW;
void main() {
	#include <uv_vertex>
	#include <batching_vertex>
	#include <skinbase_vertex>
	#include <morphinstance_vertex>
	#ifdef USE_DISPLACEMENTMAP
		#include <beginnormal_vertex>
		#include <morphnormal_vertex>
		#include <skinnormal_vertex>
	#endif
	#include <begin_vertex>
	#include <morphtarget_vertex>
	#include <skinning_vertex>
	#include <displacementmap_vertex>
	#include <project_vertex>
	#include <logdepthbuf_vertex>
	#include <clipping_planes_vertex>
	vHighPrecisionZW = gl_Position.zw;
}`,lw=`#if DEPTH_PACKING == 3200
	uniform float opacity;
#endif
#include <common>
#include <packing>
#include <uv_pars_fragment>
#include <map_pars_fragment>
#include <alphamap_pars_fragment>
#include <alphatest_pars_fragment>
#include <alphahash_pars_fragment>
#include <logdepthbuf_pars_fragment>
#include <clipping_planes_pars_fragment>
varying vec2 vHighPrecisionZW;
void main() {
	vec4 diffuseColor = vec4( 1.0 );
	#include <clipping_planes_fragment>
	#if DEPTH_PACKING == 3200
		diffuseColor.a = opacity;
	#endif
	#include <map_fragment>
	#include <alphamap_fragment>
	#include <alphatest_fragment>
	#include <alphahash_fragment>
	#include <logdepthbuf_fragment>
	#ifdef USE_REVERSED_DEPTH_BUFFER
		float fragCoordZ = vHighPrecisionZW[ 0 ] / vHighPrecisionZW[ 1 ];
	#else
		float fragCoordZ = 0.5 * vHighPrecisionZW[ 0 ] / vHighPrecisionZW[ 1 ] + 0.5;
	#endif
	#if DEPTH_PACKING == 3200
		gl_FragColor = vec4( vec3( 1.0 - fragCoordZ ), opacity );
	#elif DEPTH_PACKING == 3201
		gl_FragColor = packDepthToRGBA( fragCoordZ );
	#elif DEPTH_PACKING == 3202
		gl_FragColor = vec4( packDepthToRGB( fragCoordZ ), 1.0 );
	#elif DEPTH_PACKING == 3203
		gl_FragColor = vec4( packDepthToRG( fragCoordZ ), 0.0, 1.0 );
	#endif
}`,cw=`#define DISTANCE
varying vec3 vWorldPosition;
#include <common>
#include <batching_pars_vertex>
#include <uv_pars_vertex>
#include <displacementmap_pars_vertex>
#include <morphtarget_pars_vertex>
#include <skinning_pars_vertex>
#include <clipping_planes_pars_vertex>
void main() {
	#include <uv_vertex>
	#include <batching_vertex>
	#include <skinbase_vertex>
	#include <morphinstance_vertex>
	#ifdef USE_DISPLACEMENTMAP
		#include <beginnormal_vertex>
		#include <morphnormal_vertex>
		#include <skinnormal_vertex>
	#endif
	#include <begin_vertex>
	#include <morphtarget_vertex>
	#include <skinning_vertex>
	#include <displacementmap_vertex>
	#include <project_vertex>
	#include <worldpos_vertex>
	#include <clipping_planes_vertex>
	vWorldPosition = worldPosition.xyz;
}`,hw=`#define DISTANCE
uniform vec3 referencePosition;
uniform float nearDistance;
uniform float farDistance;
varying vec3 vWorldPosition;
#include <common>
#include <uv_pars_fragment>
#include <map_pars_fragment>
#include <alphamap_pars_fragment>
#include <alphatest_pars_fragment>
#include <alphahash_pars_fragment>
#include <clipping_planes_pars_fragment>
void main() {
	vec4 diffuseColor = vec4( 1.0 );
	#include <clipping_planes_fragment>
	#include <map_fragment>
	#include <alphamap_fragment>
	#include <alphatest_fragment>
	#include <alphahash_fragment>
	float dist = length( vWorldPosition - referencePosition );
	dist = ( dist - nearDistance ) / ( farDistance - nearDistance );
	dist = saturate( dist );
	gl_FragColor = vec4( dist, 0.0, 0.0, 1.0 );
}`,uw=`varying vec3 vWorldDirection;
#include <common>
void main() {
	vWorldDirection = transformDirection( position, modelMatrix );
	#include <begin_vertex>
	#include <project_vertex>
}`,fw=`uniform sampler2D tEquirect;
varying vec3 vWorldDirection;
#include <common>
void main() {
	vec3 direction = normalize( vWorldDirection );
	vec2 sampleUV = equirectUv( direction );
	gl_FragColor = texture2D( tEquirect, sampleUV );
	#include <tonemapping_fragment>
	#include <colorspace_fragment>
}`,dw=`uniform float scale;
attribute float lineDistance;
varying float vLineDistance;
#include <common>
#include <uv_pars_vertex>
#include <color_pars_vertex>
#include <fog_pars_vertex>
#include <morphtarget_pars_vertex>
#include <logdepthbuf_pars_vertex>
#include <clipping_planes_pars_vertex>
void main() {
	vLineDistance = scale * lineDistance;
	#include <uv_vertex>
	#include <color_vertex>
	#include <morphinstance_vertex>
	#include <morphcolor_vertex>
	#include <begin_vertex>
	#include <morphtarget_vertex>
	#include <project_vertex>
	#include <logdepthbuf_vertex>
	#include <clipping_planes_vertex>
	#include <fog_vertex>
}`,pw=`uniform vec3 diffuse;
uniform float opacity;
uniform float dashSize;
uniform float totalSize;
varying float vLineDistance;
#include <common>
#include <color_pars_fragment>
#include <uv_pars_fragment>
#include <map_pars_fragment>
#include <fog_pars_fragment>
#include <logdepthbuf_pars_fragment>
#include <clipping_planes_pars_fragment>
void main() {
	vec4 diffuseColor = vec4( diffuse, opacity );
	#include <clipping_planes_fragment>
	if ( mod( vLineDistance, totalSize ) > dashSize ) {
		discard;
	}
	vec3 outgoingLight = vec3( 0.0 );
	#include <logdepthbuf_fragment>
	#include <map_fragment>
	#include <color_fragment>
	outgoingLight = diffuseColor.rgb;
	#include <opaque_fragment>
	#include <tonemapping_fragment>
	#include <colorspace_fragment>
	#include <fog_fragment>
	#include <premultiplied_alpha_fragment>
}`,mw=`#include <common>
#include <batching_pars_vertex>
#include <uv_pars_vertex>
#include <envmap_pars_vertex>
#include <color_pars_vertex>
#include <fog_pars_vertex>
#include <morphtarget_pars_vertex>
#include <skinning_pars_vertex>
#include <logdepthbuf_pars_vertex>
#include <clipping_planes_pars_vertex>
void main() {
	#include <uv_vertex>
	#include <color_vertex>
	#include <morphinstance_vertex>
	#include <morphcolor_vertex>
	#include <batching_vertex>
	#if defined ( USE_ENVMAP ) || defined ( USE_SKINNING )
		#include <beginnormal_vertex>
		#include <morphnormal_vertex>
		#include <skinbase_vertex>
		#include <skinnormal_vertex>
		#include <defaultnormal_vertex>
	#endif
	#include <begin_vertex>
	#include <morphtarget_vertex>
	#include <skinning_vertex>
	#include <project_vertex>
	#include <logdepthbuf_vertex>
	#include <clipping_planes_vertex>
	#include <worldpos_vertex>
	#include <envmap_vertex>
	#include <fog_vertex>
}`,gw=`uniform vec3 diffuse;
uniform float opacity;
#ifndef FLAT_SHADED
	varying vec3 vNormal;
#endif
#include <common>
#include <dithering_pars_fragment>
#include <color_pars_fragment>
#include <uv_pars_fragment>
#include <map_pars_fragment>
#include <alphamap_pars_fragment>
#include <alphatest_pars_fragment>
#include <alphahash_pars_fragment>
#include <aomap_pars_fragment>
#include <lightmap_pars_fragment>
#include <envmap_common_pars_fragment>
#include <envmap_pars_fragment>
#include <fog_pars_fragment>
#include <specularmap_pars_fragment>
#include <logdepthbuf_pars_fragment>
#include <clipping_planes_pars_fragment>
void main() {
	vec4 diffuseColor = vec4( diffuse, opacity );
	#include <clipping_planes_fragment>
	#include <logdepthbuf_fragment>
	#include <map_fragment>
	#include <color_fragment>
	#include <alphamap_fragment>
	#include <alphatest_fragment>
	#include <alphahash_fragment>
	#include <specularmap_fragment>
	ReflectedLight reflectedLight = ReflectedLight( vec3( 0.0 ), vec3( 0.0 ), vec3( 0.0 ), vec3( 0.0 ) );
	#ifdef USE_LIGHTMAP
		vec4 lightMapTexel = texture2D( lightMap, vLightMapUv );
		reflectedLight.indirectDiffuse += lightMapTexel.rgb * lightMapIntensity * RECIPROCAL_PI;
	#else
		reflectedLight.indirectDiffuse += vec3( 1.0 );
	#endif
	#include <aomap_fragment>
	reflectedLight.indirectDiffuse *= diffuseColor.rgb;
	vec3 outgoingLight = reflectedLight.indirectDiffuse;
	#include <envmap_fragment>
	#include <opaque_fragment>
	#include <tonemapping_fragment>
	#include <colorspace_fragment>
	#include <fog_fragment>
	#include <premultiplied_alpha_fragment>
	#include <dithering_fragment>
}`,_w=`#define LAMBERT
varying vec3 vViewPosition;
#include <common>
#include <batching_pars_vertex>
#include <uv_pars_vertex>
#include <displacementmap_pars_vertex>
#include <envmap_pars_vertex>
#include <color_pars_vertex>
#include <fog_pars_vertex>
#include <normal_pars_vertex>
#include <morphtarget_pars_vertex>
#include <skinning_pars_vertex>
#include <shadowmap_pars_vertex>
#include <logdepthbuf_pars_vertex>
#include <clipping_planes_pars_vertex>
void main() {
	#include <uv_vertex>
	#include <color_vertex>
	#include <morphinstance_vertex>
	#include <morphcolor_vertex>
	#include <batching_vertex>
	#include <beginnormal_vertex>
	#include <morphnormal_vertex>
	#include <skinbase_vertex>
	#include <skinnormal_vertex>
	#include <defaultnormal_vertex>
	#include <normal_vertex>
	#include <begin_vertex>
	#include <morphtarget_vertex>
	#include <skinning_vertex>
	#include <displacementmap_vertex>
	#include <project_vertex>
	#include <logdepthbuf_vertex>
	#include <clipping_planes_vertex>
	vViewPosition = - mvPosition.xyz;
	#include <worldpos_vertex>
	#include <envmap_vertex>
	#include <shadowmap_vertex>
	#include <fog_vertex>
}`,xw=`#define LAMBERT
uniform vec3 diffuse;
uniform vec3 emissive;
uniform float opacity;
#include <common>
#include <dithering_pars_fragment>
#include <color_pars_fragment>
#include <uv_pars_fragment>
#include <map_pars_fragment>
#include <alphamap_pars_fragment>
#include <alphatest_pars_fragment>
#include <alphahash_pars_fragment>
#include <aomap_pars_fragment>
#include <lightmap_pars_fragment>
#include <emissivemap_pars_fragment>
#include <envmap_common_pars_fragment>
#include <envmap_pars_fragment>
#include <envmap_physical_pars_fragment>
#include <fog_pars_fragment>
#include <bsdfs>
#include <lights_pars_begin>
#include <normal_pars_fragment>
#include <lights_lambert_pars_fragment>
#include <shadowmap_pars_fragment>
#include <bumpmap_pars_fragment>
#include <normalmap_pars_fragment>
#include <specularmap_pars_fragment>
#include <logdepthbuf_pars_fragment>
#include <clipping_planes_pars_fragment>
void main() {
	vec4 diffuseColor = vec4( diffuse, opacity );
	#include <clipping_planes_fragment>
	ReflectedLight reflectedLight = ReflectedLight( vec3( 0.0 ), vec3( 0.0 ), vec3( 0.0 ), vec3( 0.0 ) );
	vec3 totalEmissiveRadiance = emissive;
	#include <logdepthbuf_fragment>
	#include <map_fragment>
	#include <color_fragment>
	#include <alphamap_fragment>
	#include <alphatest_fragment>
	#include <alphahash_fragment>
	#include <specularmap_fragment>
	#include <normal_fragment_begin>
	#include <normal_fragment_maps>
	#include <emissivemap_fragment>
	#include <lights_lambert_fragment>
	#include <lights_fragment_begin>
	#include <lights_fragment_maps>
	#include <lights_fragment_end>
	#include <aomap_fragment>
	vec3 outgoingLight = reflectedLight.directDiffuse + reflectedLight.indirectDiffuse + totalEmissiveRadiance;
	#include <envmap_fragment>
	#include <opaque_fragment>
	#include <tonemapping_fragment>
	#include <colorspace_fragment>
	#include <fog_fragment>
	#include <premultiplied_alpha_fragment>
	#include <dithering_fragment>
}`,yw=`#define MATCAP
varying vec3 vViewPosition;
#include <common>
#include <batching_pars_vertex>
#include <uv_pars_vertex>
#include <color_pars_vertex>
#include <displacementmap_pars_vertex>
#include <fog_pars_vertex>
#include <normal_pars_vertex>
#include <morphtarget_pars_vertex>
#include <skinning_pars_vertex>
#include <logdepthbuf_pars_vertex>
#include <clipping_planes_pars_vertex>
void main() {
	#include <uv_vertex>
	#include <color_vertex>
	#include <morphinstance_vertex>
	#include <morphcolor_vertex>
	#include <batching_vertex>
	#include <beginnormal_vertex>
	#include <morphnormal_vertex>
	#include <skinbase_vertex>
	#include <skinnormal_vertex>
	#include <defaultnormal_vertex>
	#include <normal_vertex>
	#include <begin_vertex>
	#include <morphtarget_vertex>
	#include <skinning_vertex>
	#include <displacementmap_vertex>
	#include <project_vertex>
	#include <logdepthbuf_vertex>
	#include <clipping_planes_vertex>
	#include <fog_vertex>
	vViewPosition = - mvPosition.xyz;
}`,vw=`#define MATCAP
uniform vec3 diffuse;
uniform float opacity;
uniform sampler2D matcap;
varying vec3 vViewPosition;
#include <common>
#include <dithering_pars_fragment>
#include <color_pars_fragment>
#include <uv_pars_fragment>
#include <map_pars_fragment>
#include <alphamap_pars_fragment>
#include <alphatest_pars_fragment>
#include <alphahash_pars_fragment>
#include <fog_pars_fragment>
#include <normal_pars_fragment>
#include <bumpmap_pars_fragment>
#include <normalmap_pars_fragment>
#include <logdepthbuf_pars_fragment>
#include <clipping_planes_pars_fragment>
void main() {
	vec4 diffuseColor = vec4( diffuse, opacity );
	#include <clipping_planes_fragment>
	#include <logdepthbuf_fragment>
	#include <map_fragment>
	#include <color_fragment>
	#include <alphamap_fragment>
	#include <alphatest_fragment>
	#include <alphahash_fragment>
	#include <normal_fragment_begin>
	#include <normal_fragment_maps>
	vec3 viewDir = normalize( vViewPosition );
	vec3 x = normalize( vec3( viewDir.z, 0.0, - viewDir.x ) );
	vec3 y = cross( viewDir, x );
	vec2 uv = vec2( dot( x, normal ), dot( y, normal ) ) * 0.495 + 0.5;
	#ifdef USE_MATCAP
		vec4 matcapColor = texture2D( matcap, uv );
	#else
		vec4 matcapColor = vec4( vec3( mix( 0.2, 0.8, uv.y ) ), 1.0 );
	#endif
	vec3 outgoingLight = diffuseColor.rgb * matcapColor.rgb;
	#include <opaque_fragment>
	#include <tonemapping_fragment>
	#include <colorspace_fragment>
	#include <fog_fragment>
	#include <premultiplied_alpha_fragment>
	#include <dithering_fragment>
}`,bw=`#define NORMAL
#if defined( FLAT_SHADED ) || defined( USE_BUMPMAP ) || defined( USE_NORMALMAP_TANGENTSPACE )
	varying vec3 vViewPosition;
#endif
#include <common>
#include <batching_pars_vertex>
#include <uv_pars_vertex>
#include <displacementmap_pars_vertex>
#include <normal_pars_vertex>
#include <morphtarget_pars_vertex>
#include <skinning_pars_vertex>
#include <logdepthbuf_pars_vertex>
#include <clipping_planes_pars_vertex>
void main() {
	#include <uv_vertex>
	#include <batching_vertex>
	#include <beginnormal_vertex>
	#include <morphinstance_vertex>
	#include <morphnormal_vertex>
	#include <skinbase_vertex>
	#include <skinnormal_vertex>
	#include <defaultnormal_vertex>
	#include <normal_vertex>
	#include <begin_vertex>
	#include <morphtarget_vertex>
	#include <skinning_vertex>
	#include <displacementmap_vertex>
	#include <project_vertex>
	#include <logdepthbuf_vertex>
	#include <clipping_planes_vertex>
#if defined( FLAT_SHADED ) || defined( USE_BUMPMAP ) || defined( USE_NORMALMAP_TANGENTSPACE )
	vViewPosition = - mvPosition.xyz;
#endif
}`,Mw=`#define NORMAL
uniform float opacity;
#if defined( FLAT_SHADED ) || defined( USE_BUMPMAP ) || defined( USE_NORMALMAP_TANGENTSPACE )
	varying vec3 vViewPosition;
#endif
#include <uv_pars_fragment>
#include <normal_pars_fragment>
#include <bumpmap_pars_fragment>
#include <normalmap_pars_fragment>
#include <logdepthbuf_pars_fragment>
#include <clipping_planes_pars_fragment>
void main() {
	vec4 diffuseColor = vec4( 0.0, 0.0, 0.0, opacity );
	#include <clipping_planes_fragment>
	#include <logdepthbuf_fragment>
	#include <normal_fragment_begin>
	#include <normal_fragment_maps>
	gl_FragColor = vec4( normalize( normal ) * 0.5 + 0.5, diffuseColor.a );
	#ifdef OPAQUE
		gl_FragColor.a = 1.0;
	#endif
}`,Sw=`#define PHONG
varying vec3 vViewPosition;
#include <common>
#include <batching_pars_vertex>
#include <uv_pars_vertex>
#include <displacementmap_pars_vertex>
#include <envmap_pars_vertex>
#include <color_pars_vertex>
#include <fog_pars_vertex>
#include <normal_pars_vertex>
#include <morphtarget_pars_vertex>
#include <skinning_pars_vertex>
#include <shadowmap_pars_vertex>
#include <logdepthbuf_pars_vertex>
#include <clipping_planes_pars_vertex>
void main() {
	#include <uv_vertex>
	#include <color_vertex>
	#include <morphcolor_vertex>
	#include <batching_vertex>
	#include <beginnormal_vertex>
	#include <morphinstance_vertex>
	#include <morphnormal_vertex>
	#include <skinbase_vertex>
	#include <skinnormal_vertex>
	#include <defaultnormal_vertex>
	#include <normal_vertex>
	#include <begin_vertex>
	#include <morphtarget_vertex>
	#include <skinning_vertex>
	#include <displacementmap_vertex>
	#include <project_vertex>
	#include <logdepthbuf_vertex>
	#include <clipping_planes_vertex>
	vViewPosition = - mvPosition.xyz;
	#include <worldpos_vertex>
	#include <envmap_vertex>
	#include <shadowmap_vertex>
	#include <fog_vertex>
}`,ww=`#define PHONG
uniform vec3 diffuse;
uniform vec3 emissive;
uniform vec3 specular;
uniform float shininess;
uniform float opacity;
#include <common>
#include <dithering_pars_fragment>
#include <color_pars_fragment>
#include <uv_pars_fragment>
#include <map_pars_fragment>
#include <alphamap_pars_fragment>
#include <alphatest_pars_fragment>
#include <alphahash_pars_fragment>
#include <aomap_pars_fragment>
#include <lightmap_pars_fragment>
#include <emissivemap_pars_fragment>
#include <envmap_common_pars_fragment>
#include <envmap_pars_fragment>
#include <envmap_physical_pars_fragment>
#include <fog_pars_fragment>
#include <bsdfs>
#include <lights_pars_begin>
#include <normal_pars_fragment>
#include <lights_phong_pars_fragment>
#include <shadowmap_pars_fragment>
#include <bumpmap_pars_fragment>
#include <normalmap_pars_fragment>
#include <specularmap_pars_fragment>
#include <logdepthbuf_pars_fragment>
#include <clipping_planes_pars_fragment>
void main() {
	vec4 diffuseColor = vec4( diffuse, opacity );
	#include <clipping_planes_fragment>
	ReflectedLight reflectedLight = ReflectedLight( vec3( 0.0 ), vec3( 0.0 ), vec3( 0.0 ), vec3( 0.0 ) );
	vec3 totalEmissiveRadiance = emissive;
	#include <logdepthbuf_fragment>
	#include <map_fragment>
	#include <color_fragment>
	#include <alphamap_fragment>
	#include <alphatest_fragment>
	#include <alphahash_fragment>
	#include <specularmap_fragment>
	#include <normal_fragment_begin>
	#include <normal_fragment_maps>
	#include <emissivemap_fragment>
	#include <lights_phong_fragment>
	#include <lights_fragment_begin>
	#include <lights_fragment_maps>
	#include <lights_fragment_end>
	#include <aomap_fragment>
	vec3 outgoingLight = reflectedLight.directDiffuse + reflectedLight.indirectDiffuse + reflectedLight.directSpecular + reflectedLight.indirectSpecular + totalEmissiveRadiance;
	#include <envmap_fragment>
	#include <opaque_fragment>
	#include <tonemapping_fragment>
	#include <colorspace_fragment>
	#include <fog_fragment>
	#include <premultiplied_alpha_fragment>
	#include <dithering_fragment>
}`,Aw=`#define STANDARD
varying vec3 vViewPosition;
#ifdef USE_TRANSMISSION
	varying vec3 vWorldPosition;
#endif
#include <common>
#include <batching_pars_vertex>
#include <uv_pars_vertex>
#include <displacementmap_pars_vertex>
#include <color_pars_vertex>
#include <fog_pars_vertex>
#include <normal_pars_vertex>
#include <morphtarget_pars_vertex>
#include <skinning_pars_vertex>
#include <shadowmap_pars_vertex>
#include <logdepthbuf_pars_vertex>
#include <clipping_planes_pars_vertex>
void main() {
	#include <uv_vertex>
	#include <color_vertex>
	#include <morphinstance_vertex>
	#include <morphcolor_vertex>
	#include <batching_vertex>
	#include <beginnormal_vertex>
	#include <morphnormal_vertex>
	#include <skinbase_vertex>
	#include <skinnormal_vertex>
	#include <defaultnormal_vertex>
	#include <normal_vertex>
	#include <begin_vertex>
	#include <morphtarget_vertex>
	#include <skinning_vertex>
	#include <displacementmap_vertex>
	#include <project_vertex>
	#include <logdepthbuf_vertex>
	#include <clipping_planes_vertex>
	vViewPosition = - mvPosition.xyz;
	#include <worldpos_vertex>
	#include <shadowmap_vertex>
	#include <fog_vertex>
#ifdef USE_TRANSMISSION
	vWorldPosition = worldPosition.xyz;
#endif
}`,Ew=`#define STANDARD
#ifdef PHYSICAL
	#define IOR
	#define USE_SPECULAR
#endif
uniform vec3 diffuse;
uniform vec3 emissive;
uniform float roughness;
uniform float metalness;
uniform float opacity;
#ifdef IOR
	uniform float ior;
#endif
#ifdef USE_SPECULAR
	uniform float specularIntensity;
	uniform vec3 specularColor;
	#ifdef USE_SPECULAR_COLORMAP
		uniform sampler2D specularColorMap;
	#endif
	#ifdef USE_SPECULAR_INTENSITYMAP
		uniform sampler2D specularIntensityMap;
	#endif
#endif
#ifdef USE_CLEARCOAT
	uniform float clearcoat;
	uniform float clearcoatRoughness;
#endif
#ifdef USE_DIFFUSE_ROUGHNESS
	uniform float diffuseRoughness;
	#ifdef USE_DIFFUSE_ROUGHNESSMAP
		uniform sampler2D diffuseRoughnessMap;
	#endif
#endif
#ifdef USE_DISPERSION
	uniform float dispersion;
#endif
#ifdef USE_RETROREFLECTION
	uniform float retroreflectivity;
#endif
#ifdef USE_IRIDESCENCE
	uniform float iridescence;
	uniform float iridescenceIOR;
	uniform float iridescenceThicknessMinimum;
	uniform float iridescenceThicknessMaximum;
#endif
#ifdef USE_SHEEN
	uniform vec3 sheenColor;
	uniform float sheenRoughness;
	#ifdef USE_SHEEN_COLORMAP
		uniform sampler2D sheenColorMap;
	#endif
	#ifdef USE_SHEEN_ROUGHNESSMAP
		uniform sampler2D sheenRoughnessMap;
	#endif
#endif
#ifdef USE_ANISOTROPY
	uniform vec2 anisotropyVector;
	#ifdef USE_ANISOTROPYMAP
		uniform sampler2D anisotropyMap;
	#endif
#endif
varying vec3 vViewPosition;
#include <common>
#include <dithering_pars_fragment>
#include <color_pars_fragment>
#include <uv_pars_fragment>
#include <map_pars_fragment>
#include <alphamap_pars_fragment>
#include <alphatest_pars_fragment>
#include <alphahash_pars_fragment>
#include <aomap_pars_fragment>
#include <lightmap_pars_fragment>
#include <emissivemap_pars_fragment>
#include <iridescence_fragment>
#include <envmap_common_pars_fragment>
#include <envmap_physical_pars_fragment>
#include <fog_pars_fragment>
#include <lights_pars_begin>
#include <normal_pars_fragment>
#include <lights_physical_pars_fragment>
#include <transmission_pars_fragment>
#include <shadowmap_pars_fragment>
#include <bumpmap_pars_fragment>
#include <normalmap_pars_fragment>
#include <clearcoat_pars_fragment>
#include <iridescence_pars_fragment>
#include <roughnessmap_pars_fragment>
#include <metalnessmap_pars_fragment>
#include <logdepthbuf_pars_fragment>
#include <clipping_planes_pars_fragment>
void main() {
	vec4 diffuseColor = vec4( diffuse, opacity );
	#include <clipping_planes_fragment>
	ReflectedLight reflectedLight = ReflectedLight( vec3( 0.0 ), vec3( 0.0 ), vec3( 0.0 ), vec3( 0.0 ) );
	vec3 totalEmissiveRadiance = emissive;
	#include <logdepthbuf_fragment>
	#include <map_fragment>
	#include <color_fragment>
	#include <alphamap_fragment>
	#include <alphatest_fragment>
	#include <alphahash_fragment>
	#include <roughnessmap_fragment>
	#include <metalnessmap_fragment>
	#include <normal_fragment_begin>
	#include <normal_fragment_maps>
	#include <clearcoat_normal_fragment_begin>
	#include <clearcoat_normal_fragment_maps>
	#include <emissivemap_fragment>
	#include <lights_physical_fragment>
	#include <lights_fragment_begin>
	#include <lights_fragment_maps>
	#include <lights_fragment_end>
	#include <aomap_fragment>
	vec3 totalDiffuse = reflectedLight.directDiffuse + reflectedLight.indirectDiffuse;
	vec3 totalSpecular = reflectedLight.directSpecular + reflectedLight.indirectSpecular;
	#include <transmission_fragment>
	vec3 outgoingLight = totalDiffuse + totalSpecular + totalEmissiveRadiance;
	#ifdef USE_SHEEN
 
		outgoingLight = outgoingLight + sheenSpecularDirect + sheenSpecularIndirect;
 
 	#endif
	#ifdef USE_CLEARCOAT
		float dotNVcc = saturate( dot( geometryClearcoatNormal, geometryViewDir ) );
		vec3 Fcc = F_Schlick( material.clearcoatF0, material.clearcoatF90, dotNVcc );
		outgoingLight = outgoingLight * ( 1.0 - material.clearcoat * Fcc ) + ( clearcoatSpecularDirect + clearcoatSpecularIndirect ) * material.clearcoat;
	#endif
	#include <opaque_fragment>
	#include <tonemapping_fragment>
	#include <colorspace_fragment>
	#include <fog_fragment>
	#include <premultiplied_alpha_fragment>
	#include <dithering_fragment>
}`,Tw=`#define TOON
varying vec3 vViewPosition;
#include <common>
#include <batching_pars_vertex>
#include <uv_pars_vertex>
#include <displacementmap_pars_vertex>
#include <color_pars_vertex>
#include <fog_pars_vertex>
#include <normal_pars_vertex>
#include <morphtarget_pars_vertex>
#include <skinning_pars_vertex>
#include <shadowmap_pars_vertex>
#include <logdepthbuf_pars_vertex>
#include <clipping_planes_pars_vertex>
void main() {
	#include <uv_vertex>
	#include <color_vertex>
	#include <morphinstance_vertex>
	#include <morphcolor_vertex>
	#include <batching_vertex>
	#include <beginnormal_vertex>
	#include <morphnormal_vertex>
	#include <skinbase_vertex>
	#include <skinnormal_vertex>
	#include <defaultnormal_vertex>
	#include <normal_vertex>
	#include <begin_vertex>
	#include <morphtarget_vertex>
	#include <skinning_vertex>
	#include <displacementmap_vertex>
	#include <project_vertex>
	#include <logdepthbuf_vertex>
	#include <clipping_planes_vertex>
	vViewPosition = - mvPosition.xyz;
	#include <worldpos_vertex>
	#include <shadowmap_vertex>
	#include <fog_vertex>
}`,Cw=`#define TOON
uniform vec3 diffuse;
uniform vec3 emissive;
uniform float opacity;
#include <common>
#include <dithering_pars_fragment>
#include <color_pars_fragment>
#include <uv_pars_fragment>
#include <map_pars_fragment>
#include <alphamap_pars_fragment>
#include <alphatest_pars_fragment>
#include <alphahash_pars_fragment>
#include <aomap_pars_fragment>
#include <lightmap_pars_fragment>
#include <emissivemap_pars_fragment>
#include <gradientmap_pars_fragment>
#include <fog_pars_fragment>
#include <bsdfs>
#include <lights_pars_begin>
#include <normal_pars_fragment>
#include <lights_toon_pars_fragment>
#include <shadowmap_pars_fragment>
#include <bumpmap_pars_fragment>
#include <normalmap_pars_fragment>
#include <logdepthbuf_pars_fragment>
#include <clipping_planes_pars_fragment>
void main() {
	vec4 diffuseColor = vec4( diffuse, opacity );
	#include <clipping_planes_fragment>
	ReflectedLight reflectedLight = ReflectedLight( vec3( 0.0 ), vec3( 0.0 ), vec3( 0.0 ), vec3( 0.0 ) );
	vec3 totalEmissiveRadiance = emissive;
	#include <logdepthbuf_fragment>
	#include <map_fragment>
	#include <color_fragment>
	#include <alphamap_fragment>
	#include <alphatest_fragment>
	#include <alphahash_fragment>
	#include <normal_fragment_begin>
	#include <normal_fragment_maps>
	#include <emissivemap_fragment>
	#include <lights_toon_fragment>
	#include <lights_fragment_begin>
	#include <lights_fragment_maps>
	#include <lights_fragment_end>
	#include <aomap_fragment>
	vec3 outgoingLight = reflectedLight.directDiffuse + reflectedLight.indirectDiffuse + totalEmissiveRadiance;
	#include <opaque_fragment>
	#include <tonemapping_fragment>
	#include <colorspace_fragment>
	#include <fog_fragment>
	#include <premultiplied_alpha_fragment>
	#include <dithering_fragment>
}`,Rw=`uniform float size;
uniform float scale;
#include <common>
#include <color_pars_vertex>
#include <fog_pars_vertex>
#include <morphtarget_pars_vertex>
#include <logdepthbuf_pars_vertex>
#include <clipping_planes_pars_vertex>
#ifdef USE_POINTS_UV
	varying vec2 vUv;
	uniform mat3 uvTransform;
#endif
void main() {
	#ifdef USE_POINTS_UV
		vUv = ( uvTransform * vec3( uv, 1 ) ).xy;
	#endif
	#include <color_vertex>
	#include <morphinstance_vertex>
	#include <morphcolor_vertex>
	#include <begin_vertex>
	#include <morphtarget_vertex>
	#include <project_vertex>
	gl_PointSize = size;
	#ifdef USE_SIZEATTENUATION
		bool isPerspective = isPerspectiveMatrix( projectionMatrix );
		if ( isPerspective ) gl_PointSize *= ( scale / - mvPosition.z );
	#endif
	#include <logdepthbuf_vertex>
	#include <clipping_planes_vertex>
	#include <worldpos_vertex>
	#include <fog_vertex>
}`,Pw=`uniform vec3 diffuse;
uniform float opacity;
#include <common>
#include <color_pars_fragment>
#include <map_particle_pars_fragment>
#include <alphatest_pars_fragment>
#include <alphahash_pars_fragment>
#include <fog_pars_fragment>
#include <logdepthbuf_pars_fragment>
#include <clipping_planes_pars_fragment>
void main() {
	vec4 diffuseColor = vec4( diffuse, opacity );
	#include <clipping_planes_fragment>
	vec3 outgoingLight = vec3( 0.0 );
	#include <logdepthbuf_fragment>
	#include <map_particle_fragment>
	#include <color_fragment>
	#include <alphatest_fragment>
	#include <alphahash_fragment>
	outgoingLight = diffuseColor.rgb;
	#include <opaque_fragment>
	#include <tonemapping_fragment>
	#include <colorspace_fragment>
	#include <fog_fragment>
	#include <premultiplied_alpha_fragment>
}`,Iw=`#include <common>
#include <batching_pars_vertex>
#include <fog_pars_vertex>
#include <morphtarget_pars_vertex>
#include <skinning_pars_vertex>
#include <logdepthbuf_pars_vertex>
#include <shadowmap_pars_vertex>
void main() {
	#include <batching_vertex>
	#include <beginnormal_vertex>
	#include <morphinstance_vertex>
	#include <morphnormal_vertex>
	#include <skinbase_vertex>
	#include <skinnormal_vertex>
	#include <defaultnormal_vertex>
	#include <begin_vertex>
	#include <morphtarget_vertex>
	#include <skinning_vertex>
	#include <project_vertex>
	#include <logdepthbuf_vertex>
	#include <worldpos_vertex>
	#include <shadowmap_vertex>
	#include <fog_vertex>
}`,Lw=`uniform vec3 color;
uniform float opacity;
#include <common>
#include <fog_pars_fragment>
#include <bsdfs>
#include <lights_pars_begin>
#include <logdepthbuf_pars_fragment>
#include <shadowmap_pars_fragment>
#include <shadowmask_pars_fragment>
void main() {
	#include <logdepthbuf_fragment>
	gl_FragColor = vec4( color, opacity * ( 1.0 - getShadowMask() ) );
	#include <tonemapping_fragment>
	#include <colorspace_fragment>
	#include <fog_fragment>
	#include <premultiplied_alpha_fragment>
}`,Nw=`uniform float rotation;
uniform vec2 center;
#include <common>
#include <uv_pars_vertex>
#include <fog_pars_vertex>
#include <logdepthbuf_pars_vertex>
#include <clipping_planes_pars_vertex>
void main() {
	#include <uv_vertex>
	vec4 mvPosition = modelViewMatrix[ 3 ];
	vec2 scale = vec2( length( modelMatrix[ 0 ].xyz ), length( modelMatrix[ 1 ].xyz ) );
	#ifndef USE_SIZEATTENUATION
		bool isPerspective = isPerspectiveMatrix( projectionMatrix );
		if ( isPerspective ) scale *= - mvPosition.z;
	#endif
	vec2 alignedPosition = ( position.xy - ( center - vec2( 0.5 ) ) ) * scale;
	vec2 rotatedPosition;
	rotatedPosition.x = cos( rotation ) * alignedPosition.x - sin( rotation ) * alignedPosition.y;
	rotatedPosition.y = sin( rotation ) * alignedPosition.x + cos( rotation ) * alignedPosition.y;
	mvPosition.xy += rotatedPosition;
	gl_Position = projectionMatrix * mvPosition;
	#include <logdepthbuf_vertex>
	#include <clipping_planes_vertex>
	#include <fog_vertex>
}`,Dw=`uniform vec3 diffuse;
uniform float opacity;
#include <common>
#include <uv_pars_fragment>
#include <map_pars_fragment>
#include <alphamap_pars_fragment>
#include <alphatest_pars_fragment>
#include <alphahash_pars_fragment>
#include <fog_pars_fragment>
#include <logdepthbuf_pars_fragment>
#include <clipping_planes_pars_fragment>
void main() {
	vec4 diffuseColor = vec4( diffuse, opacity );
	#include <clipping_planes_fragment>
	vec3 outgoingLight = vec3( 0.0 );
	#include <logdepthbuf_fragment>
	#include <map_fragment>
	#include <alphamap_fragment>
	#include <alphatest_fragment>
	#include <alphahash_fragment>
	outgoingLight = diffuseColor.rgb;
	#include <opaque_fragment>
	#include <tonemapping_fragment>
	#include <colorspace_fragment>
	#include <fog_fragment>
}`,Xt={alphahash_fragment:nM,alphahash_pars_fragment:iM,alphamap_fragment:sM,alphamap_pars_fragment:rM,alphatest_fragment:oM,alphatest_pars_fragment:aM,aomap_fragment:lM,aomap_pars_fragment:cM,batching_pars_vertex:hM,batching_vertex:uM,begin_vertex:fM,beginnormal_vertex:dM,bsdfs:pM,iridescence_fragment:mM,bumpmap_pars_fragment:gM,clipping_planes_fragment:_M,clipping_planes_pars_fragment:xM,clipping_planes_pars_vertex:yM,clipping_planes_vertex:vM,color_fragment:bM,color_pars_fragment:MM,color_pars_vertex:SM,color_vertex:wM,common:AM,defaultnormal_vertex:EM,displacementmap_pars_vertex:TM,displacementmap_vertex:CM,emissivemap_fragment:RM,emissivemap_pars_fragment:PM,colorspace_fragment:IM,colorspace_pars_fragment:LM,envmap_fragment:NM,envmap_common_pars_fragment:DM,envmap_pars_fragment:UM,envmap_pars_vertex:OM,envmap_physical_pars_fragment:qM,envmap_vertex:FM,fog_vertex:BM,fog_pars_vertex:kM,fog_fragment:zM,fog_pars_fragment:VM,gradientmap_pars_fragment:GM,lightmap_pars_fragment:HM,lights_lambert_fragment:WM,lights_lambert_pars_fragment:XM,lights_pars_begin:$M,lights_toon_fragment:YM,lights_toon_pars_fragment:ZM,lights_phong_fragment:JM,lights_phong_pars_fragment:jM,lights_physical_fragment:KM,lights_physical_pars_fragment:QM,lights_fragment_begin:tS,lights_fragment_maps:eS,lights_fragment_end:nS,lightprobes_pars_fragment:iS,logdepthbuf_fragment:sS,logdepthbuf_pars_fragment:rS,logdepthbuf_pars_vertex:oS,logdepthbuf_vertex:aS,map_fragment:lS,map_pars_fragment:cS,map_particle_fragment:hS,map_particle_pars_fragment:uS,metalnessmap_fragment:fS,metalnessmap_pars_fragment:dS,morphinstance_vertex:pS,morphcolor_vertex:mS,morphnormal_vertex:gS,morphtarget_pars_vertex:_S,morphtarget_vertex:xS,normal_fragment_begin:yS,normal_fragment_maps:vS,normal_pars_fragment:bS,normal_pars_vertex:MS,normal_vertex:SS,normalmap_pars_fragment:wS,clearcoat_normal_fragment_begin:AS,clearcoat_normal_fragment_maps:ES,clearcoat_pars_fragment:TS,iridescence_pars_fragment:CS,opaque_fragment:RS,packing:PS,premultiplied_alpha_fragment:IS,project_vertex:LS,dithering_fragment:NS,dithering_pars_fragment:DS,roughnessmap_fragment:US,roughnessmap_pars_fragment:OS,shadowmap_pars_fragment:FS,shadowmap_pars_vertex:BS,shadowmap_vertex:kS,shadowmask_pars_fragment:zS,skinbase_vertex:VS,skinning_pars_vertex:GS,skinning_vertex:HS,skinnormal_vertex:WS,specularmap_fragment:XS,specularmap_pars_fragment:$S,tonemapping_fragment:qS,tonemapping_pars_fragment:YS,transmission_fragment:ZS,transmission_pars_fragment:JS,uv_pars_fragment:jS,uv_pars_vertex:KS,uv_vertex:QS,worldpos_vertex:tw,background_vert:ew,background_frag:nw,backgroundCube_vert:iw,backgroundCube_frag:sw,cube_vert:rw,cube_frag:ow,depth_vert:aw,depth_frag:lw,distance_vert:cw,distance_frag:hw,equirect_vert:uw,equirect_frag:fw,linedashed_vert:dw,linedashed_frag:pw,meshbasic_vert:mw,meshbasic_frag:gw,meshlambert_vert:_w,meshlambert_frag:xw,meshmatcap_vert:yw,meshmatcap_frag:vw,meshnormal_vert:bw,meshnormal_frag:Mw,meshphong_vert:Sw,meshphong_frag:ww,meshphysical_vert:Aw,meshphysical_frag:Ew,meshtoon_vert:Tw,meshtoon_frag:Cw,points_vert:Rw,points_frag:Pw,shadow_vert:Iw,shadow_frag:Lw,sprite_vert:Nw,sprite_frag:Dw},xt={common:{diffuse:{value:new Gt(16777215)},opacity:{value:1},map:{value:null},mapTransform:{value:new Bt},alphaMap:{value:null},alphaMapTransform:{value:new Bt},alphaTest:{value:0}},specularmap:{specularMap:{value:null},specularMapTransform:{value:new Bt}},envmap:{envMap:{value:null},envMapRotation:{value:new Bt},reflectivity:{value:1},ior:{value:1.5},refractionRatio:{value:.98},dfgLUT:{value:null}},aomap:{aoMap:{value:null},aoMapIntensity:{value:1},aoMapTransform:{value:new Bt}},lightmap:{lightMap:{value:null},lightMapIntensity:{value:1},lightMapTransform:{value:new Bt}},bumpmap:{bumpMap:{value:null},bumpMapTransform:{value:new Bt},bumpScale:{value:1}},normalmap:{normalMap:{value:null},normalMapTransform:{value:new Bt},normalScale:{value:new ht(1,1)}},displacementmap:{displacementMap:{value:null},displacementMapTransform:{value:new Bt},displacementScale:{value:1},displacementBias:{value:0}},emissivemap:{emissiveMap:{value:null},emissiveMapTransform:{value:new Bt}},metalnessmap:{metalnessMap:{value:null},metalnessMapTransform:{value:new Bt}},roughnessmap:{roughnessMap:{value:null},roughnessMapTransform:{value:new Bt}},gradientmap:{gradientMap:{value:null}},fog:{fogDensity:{value:25e-5},fogNear:{value:1},fogFar:{value:2e3},fogColor:{value:new Gt(16777215)}},lights:{ambientLightColor:{value:[]},lightProbe:{value:[]},sunLights:{value:[],properties:{direction:{},color:{}}},sunLightShadows:{value:[],properties:{shadowIntensity:1,shadowBias:{},shadowNormalBias:{},shadowRadius:{},shadowMapSize:{}}},sunShadowMatrix:{value:[]},sunShadowCascade:{value:[]},directionalLights:{value:[],properties:{direction:{},color:{}}},directionalLightShadows:{value:[],properties:{shadowIntensity:1,shadowBias:{},shadowNormalBias:{},shadowRadius:{},shadowMapSize:{}}},directionalShadowMatrix:{value:[]},spotLights:{value:[],properties:{color:{},position:{},direction:{},distance:{},coneCos:{},penumbraCos:{},decay:{}}},spotLightShadows:{value:[],properties:{shadowIntensity:1,shadowBias:{},shadowNormalBias:{},shadowRadius:{},shadowMapSize:{}}},spotLightMap:{value:[]},spotLightMatrix:{value:[]},pointLights:{value:[],properties:{color:{},position:{},decay:{},distance:{}}},pointLightShadows:{value:[],properties:{shadowIntensity:1,shadowBias:{},shadowNormalBias:{},shadowRadius:{},shadowMapSize:{},shadowCameraNear:{},shadowCameraFar:{}}},pointShadowMatrix:{value:[]},hemisphereLights:{value:[],properties:{direction:{},skyColor:{},groundColor:{}}},rectAreaLights:{value:[],properties:{color:{},position:{},width:{},height:{}}},ltc_1:{value:null},ltc_2:{value:null},probesSH:{value:[]},probesMin:{value:[]},probesMax:{value:[]},probesResolution:{value:[]}},points:{diffuse:{value:new Gt(16777215)},opacity:{value:1},size:{value:1},scale:{value:1},map:{value:null},alphaMap:{value:null},alphaMapTransform:{value:new Bt},alphaTest:{value:0},uvTransform:{value:new Bt}},sprite:{diffuse:{value:new Gt(16777215)},opacity:{value:1},center:{value:new ht(.5,.5)},rotation:{value:0},map:{value:null},mapTransform:{value:new Bt},alphaMap:{value:null},alphaMapTransform:{value:new Bt},alphaTest:{value:0}}},tn={basic:{uniforms:$e([xt.common,xt.specularmap,xt.envmap,xt.aomap,xt.lightmap,xt.fog]),vertexShader:Xt.meshbasic_vert,fragmentShader:Xt.meshbasic_frag},lambert:{uniforms:$e([xt.common,xt.specularmap,xt.envmap,xt.aomap,xt.lightmap,xt.emissivemap,xt.bumpmap,xt.normalmap,xt.displacementmap,xt.fog,xt.lights,{emissive:{value:new Gt(0)},envMapIntensity:{value:1}}]),vertexShader:Xt.meshlambert_vert,fragmentShader:Xt.meshlambert_frag},phong:{uniforms:$e([xt.common,xt.specularmap,xt.envmap,xt.aomap,xt.lightmap,xt.emissivemap,xt.bumpmap,xt.normalmap,xt.displacementmap,xt.fog,xt.lights,{emissive:{value:new Gt(0)},specular:{value:new Gt(1118481)},shininess:{value:30},envMapIntensity:{value:1}}]),vertexShader:Xt.meshphong_vert,fragmentShader:Xt.meshphong_frag},standard:{uniforms:$e([xt.common,xt.envmap,xt.aomap,xt.lightmap,xt.emissivemap,xt.bumpmap,xt.normalmap,xt.displacementmap,xt.roughnessmap,xt.metalnessmap,xt.fog,xt.lights,{emissive:{value:new Gt(0)},roughness:{value:1},metalness:{value:0},envMapIntensity:{value:1}}]),vertexShader:Xt.meshphysical_vert,fragmentShader:Xt.meshphysical_frag},toon:{uniforms:$e([xt.common,xt.aomap,xt.lightmap,xt.emissivemap,xt.bumpmap,xt.normalmap,xt.displacementmap,xt.gradientmap,xt.fog,xt.lights,{emissive:{value:new Gt(0)}}]),vertexShader:Xt.meshtoon_vert,fragmentShader:Xt.meshtoon_frag},matcap:{uniforms:$e([xt.common,xt.bumpmap,xt.normalmap,xt.displacementmap,xt.fog,{matcap:{value:null}}]),vertexShader:Xt.meshmatcap_vert,fragmentShader:Xt.meshmatcap_frag},points:{uniforms:$e([xt.points,xt.fog]),vertexShader:Xt.points_vert,fragmentShader:Xt.points_frag},dashed:{uniforms:$e([xt.common,xt.fog,{scale:{value:1},dashSize:{value:1},totalSize:{value:2}}]),vertexShader:Xt.linedashed_vert,fragmentShader:Xt.linedashed_frag},depth:{uniforms:$e([xt.common,xt.displacementmap]),vertexShader:Xt.depth_vert,fragmentShader:Xt.depth_frag},normal:{uniforms:$e([xt.common,xt.bumpmap,xt.normalmap,xt.displacementmap,{opacity:{value:1}}]),vertexShader:Xt.meshnormal_vert,fragmentShader:Xt.meshnormal_frag},sprite:{uniforms:$e([xt.sprite,xt.fog]),vertexShader:Xt.sprite_vert,fragmentShader:Xt.sprite_frag},background:{uniforms:{uvTransform:{value:new Bt},t2D:{value:null},backgroundIntensity:{value:1}},vertexShader:Xt.background_vert,fragmentShader:Xt.background_frag},backgroundCube:{uniforms:{envMap:{value:null},backgroundBlurriness:{value:0},backgroundIntensity:{value:1},backgroundRotation:{value:new Bt}},vertexShader:Xt.backgroundCube_vert,fragmentShader:Xt.backgroundCube_frag},cube:{uniforms:{tCube:{value:null},tFlip:{value:-1},opacity:{value:1}},vertexShader:Xt.cube_vert,fragmentShader:Xt.cube_frag},equirect:{uniforms:{tEquirect:{value:null}},vertexShader:Xt.equirect_vert,fragmentShader:Xt.equirect_frag},distance:{uniforms:$e([xt.common,xt.displacementmap,{referencePosition:{value:new P},nearDistance:{value:1},farDistance:{value:1e3}}]),vertexShader:Xt.distance_vert,fragmentShader:Xt.distance_frag},shadow:{uniforms:$e([xt.lights,xt.fog,{color:{value:new Gt(0)},opacity:{value:1}}]),vertexShader:Xt.shadow_vert,fragmentShader:Xt.shadow_frag}};tn.physical={uniforms:$e([tn.standard.uniforms,{clearcoat:{value:0},clearcoatMap:{value:null},clearcoatMapTransform:{value:new Bt},clearcoatNormalMap:{value:null},clearcoatNormalMapTransform:{value:new Bt},clearcoatNormalScale:{value:new ht(1,1)},clearcoatRoughness:{value:0},clearcoatRoughnessMap:{value:null},clearcoatRoughnessMapTransform:{value:new Bt},diffuseRoughness:{value:0},diffuseRoughnessMap:{value:null},diffuseRoughnessMapTransform:{value:new Bt},dispersion:{value:0},retroreflectivity:{value:0},iridescence:{value:0},iridescenceMap:{value:null},iridescenceMapTransform:{value:new Bt},iridescenceIOR:{value:1.3},iridescenceThicknessMinimum:{value:100},iridescenceThicknessMaximum:{value:400},iridescenceThicknessMap:{value:null},iridescenceThicknessMapTransform:{value:new Bt},sheen:{value:0},sheenColor:{value:new Gt(0)},sheenColorMap:{value:null},sheenColorMapTransform:{value:new Bt},sheenRoughness:{value:1},sheenRoughnessMap:{value:null},sheenRoughnessMapTransform:{value:new Bt},transmission:{value:0},transmissionMap:{value:null},transmissionMapTransform:{value:new Bt},transmissionSamplerSize:{value:new ht},transmissionSamplerMap:{value:null},thickness:{value:0},thicknessMap:{value:null},thicknessMapTransform:{value:new Bt},attenuationDistance:{value:0},attenuationColor:{value:new Gt(0)},specularColor:{value:new Gt(1,1,1)},specularColorMap:{value:null},specularColorMapTransform:{value:new Bt},specularIntensity:{value:1},specularIntensityMap:{value:null},specularIntensityMapTransform:{value:new Bt},anisotropyVector:{value:new ht},anisotropyMap:{value:null},anisotropyMapTransform:{value:new Bt}}]),vertexShader:Xt.meshphysical_vert,fragmentShader:Xt.meshphysical_frag};var ih={r:0,b:0,g:0},Uw=new re,c_=new Bt;c_.set(-1,0,0,0,1,0,0,0,1);function Ow(n,t,e,i,s,r){let o=new Gt(0),a=s===!0?0:1,c,l,h=null,u=0,f=null;function d(x){let b=x.isScene===!0?x.background:null;if(b&&b.isTexture){let v=x.backgroundBlurriness>0;b=t.get(b,v)}return b}function m(x){let b=!1,v=d(x);v===null?p(o,a):v&&v.isColor&&(p(v,1),b=!0);let w=n.xr.getEnvironmentBlendMode();w==="additive"?e.buffers.color.setClear(0,0,0,1,r):w==="alpha-blend"&&e.buffers.color.setClear(0,0,0,0,r),(n.autoClear||b)&&(e.buffers.depth.setTest(!0),e.buffers.depth.setMask(!0),e.buffers.color.setMask(!0),n.clear(n.autoClearColor,n.autoClearDepth,n.autoClearStencil))}function _(x,b){let v=d(b);v&&v.isCubeTexture?(l===void 0&&(l=new de(new yi(1,1,1),new En({name:"BackgroundCubeMaterial",uniforms:Ds(tn.backgroundCube.uniforms),vertexShader:tn.backgroundCube.vertexShader,fragmentShader:tn.backgroundCube.fragmentShader,side:Ue,depthTest:!1,depthWrite:!1,fog:!1,allowOverride:!1})),l.geometry.deleteAttribute("normal"),l.geometry.deleteAttribute("uv"),l.onBeforeRender=function(w,E,y){this.matrixWorld.copyPosition(y.matrixWorld)},Object.defineProperty(l.material,"envMap",{get:function(){return this.uniforms.envMap.value}}),i.update(l)),l.material.uniforms.envMap.value=v,l.material.uniforms.backgroundBlurriness.value=b.backgroundBlurriness,l.material.uniforms.backgroundIntensity.value=b.backgroundIntensity,l.material.uniforms.backgroundRotation.value.setFromMatrix4(Uw.makeRotationFromEuler(b.backgroundRotation)).transpose(),v.isRenderTargetTexture===!1&&l.material.uniforms.backgroundRotation.value.premultiply(c_),l.material.toneMapped=Jt.getTransfer(v.colorSpace)!==se,(h!==v||u!==v.version||f!==n.toneMapping)&&(l.material.needsUpdate=!0,h=v,u=v.version,f=n.toneMapping),l.layers.enableAll(),x.unshift(l,l.geometry,l.material,0,0,null)):v&&v.isTexture&&(c===void 0&&(c=new de(new Ts(2,2),new En({name:"BackgroundMaterial",uniforms:Ds(tn.background.uniforms),vertexShader:tn.background.vertexShader,fragmentShader:tn.background.fragmentShader,side:Zi,depthTest:!1,depthWrite:!1,fog:!1,allowOverride:!1})),c.geometry.deleteAttribute("normal"),Object.defineProperty(c.material,"map",{get:function(){return this.uniforms.t2D.value}}),i.update(c)),c.material.uniforms.t2D.value=v,c.material.uniforms.backgroundIntensity.value=b.backgroundIntensity,c.material.toneMapped=Jt.getTransfer(v.colorSpace)!==se,v.matrixAutoUpdate===!0&&v.updateMatrix(),c.material.uniforms.uvTransform.value.copy(v.matrix),(h!==v||u!==v.version||f!==n.toneMapping)&&(c.material.needsUpdate=!0,h=v,u=v.version,f=n.toneMapping),c.layers.enableAll(),x.unshift(c,c.geometry,c.material,0,0,null))}function p(x,b){x.getRGB(ih,td(n)),e.buffers.color.setClear(ih.r,ih.g,ih.b,b,r)}function g(){l!==void 0&&(l.geometry.dispose(),l.material.dispose(),l=void 0),c!==void 0&&(c.geometry.dispose(),c.material.dispose(),c=void 0)}return{getClearColor:function(){return o},setClearColor:function(x,b=1){o.set(x),a=b,p(o,a)},getClearAlpha:function(){return a},setClearAlpha:function(x){a=x,p(o,a)},render:m,addToRenderList:_,dispose:g}}function Fw(n,t){let e=n.getParameter(n.MAX_VERTEX_ATTRIBS),i={},s=f(null),r=s,o=!1;function a(D,N,B,C,z){let $=!1,G=u(D,C,B,N);r!==G&&(r=G,l(r.object)),$=d(D,C,B,z),$&&m(D,C,B,z),z!==null&&t.update(z,n.ELEMENT_ARRAY_BUFFER),($||o)&&(o=!1,v(D,N,B,C),z!==null&&n.bindBuffer(n.ELEMENT_ARRAY_BUFFER,t.get(z).buffer))}function c(){return n.createVertexArray()}function l(D){return n.bindVertexArray(D)}function h(D){return n.deleteVertexArray(D)}function u(D,N,B,C){let z=C.wireframe===!0,$=i[N.id];$===void 0&&($={},i[N.id]=$);let G=D.isInstancedMesh===!0?D.id:0,st=$[G];st===void 0&&(st={},$[G]=st);let X=st[B.id];X===void 0&&(X={},st[B.id]=X);let Z=X[z];return Z===void 0&&(Z=f(c()),X[z]=Z),Z}function f(D){let N=[],B=[],C=[];for(let z=0;z<e;z++)N[z]=0,B[z]=0,C[z]=0;return{geometry:null,program:null,wireframe:!1,newAttributes:N,enabledAttributes:B,attributeDivisors:C,object:D,attributes:{},index:null}}function d(D,N,B,C){let z=r.attributes,$=N.attributes,G=0,st=B.getAttributes();for(let X in st)if(st[X].location>=0){let it=z[X],Mt=$[X];if(Mt===void 0&&(X==="instanceMatrix"&&D.instanceMatrix&&(Mt=D.instanceMatrix),X==="instanceColor"&&D.instanceColor&&(Mt=D.instanceColor)),it===void 0||it.attribute!==Mt||Mt&&it.data!==Mt.data)return!0;G++}return r.attributesNum!==G||r.index!==C}function m(D,N,B,C){let z={},$=N.attributes,G=0,st=B.getAttributes();for(let X in st)if(st[X].location>=0){let it=$[X];it===void 0&&(X==="instanceMatrix"&&D.instanceMatrix&&(it=D.instanceMatrix),X==="instanceColor"&&D.instanceColor&&(it=D.instanceColor));let Mt={};Mt.attribute=it,it&&it.data&&(Mt.data=it.data),z[X]=Mt,G++}r.attributes=z,r.attributesNum=G,r.index=C}function _(){let D=r.newAttributes;for(let N=0,B=D.length;N<B;N++)D[N]=0}function p(D){g(D,0)}function g(D,N){let B=r.newAttributes,C=r.enabledAttributes,z=r.attributeDivisors;B[D]=1,C[D]===0&&(n.enableVertexAttribArray(D),C[D]=1),z[D]!==N&&(n.vertexAttribDivisor(D,N),z[D]=N)}function x(){let D=r.newAttributes,N=r.enabledAttributes;for(let B=0,C=N.length;B<C;B++)N[B]!==D[B]&&(n.disableVertexAttribArray(B),N[B]=0)}function b(D,N,B,C,z,$,G){G===!0?n.vertexAttribIPointer(D,N,B,z,$):n.vertexAttribPointer(D,N,B,C,z,$)}function v(D,N,B,C){_();let z=C.attributes,$=B.getAttributes(),G=N.defaultAttributeValues;for(let st in $){let X=$[st];if(X.location>=0){let Z=z[st];if(Z===void 0&&(st==="instanceMatrix"&&D.instanceMatrix&&(Z=D.instanceMatrix),st==="instanceColor"&&D.instanceColor&&(Z=D.instanceColor)),Z!==void 0){let it=Z.normalized,Mt=Z.itemSize,Dt=t.get(Z);if(Dt===void 0)continue;let j=Dt.buffer,W=Dt.type,et=Dt.bytesPerElement,ot=W===n.INT||W===n.UNSIGNED_INT||Z.gpuType===yc;if(Z.isInterleavedBufferAttribute){let O=Z.data,K=O.isInterleavedBuffer===!0?O.stride:O.itemSize,Tt=Z.offset;if(O.isInstancedInterleavedBuffer||O.isInstancedBufferAttribute){for(let ct=0;ct<X.locationSize;ct++)g(X.location+ct,O.meshPerAttribute);D.isInstancedMesh!==!0&&C._maxInstanceCount===void 0&&(C._maxInstanceCount=O.meshPerAttribute*O.count)}else for(let ct=0;ct<X.locationSize;ct++)p(X.location+ct);n.bindBuffer(n.ARRAY_BUFFER,j);for(let ct=0;ct<X.locationSize;ct++)b(X.location+ct,Mt/X.locationSize,W,it,K*et,(Tt+Mt/X.locationSize*ct)*et,ot)}else{if(Z.isInstancedBufferAttribute){for(let O=0;O<X.locationSize;O++)g(X.location+O,Z.meshPerAttribute);D.isInstancedMesh!==!0&&C._maxInstanceCount===void 0&&(C._maxInstanceCount=Z.meshPerAttribute*Z.count)}else for(let O=0;O<X.locationSize;O++)p(X.location+O);n.bindBuffer(n.ARRAY_BUFFER,j);for(let O=0;O<X.locationSize;O++)b(X.location+O,Mt/X.locationSize,W,it,Mt*et,Mt/X.locationSize*O*et,ot)}}else if(G!==void 0){let it=G[st];if(it!==void 0)switch(it.length){case 2:n.vertexAttrib2fv(X.location,it);break;case 3:n.vertexAttrib3fv(X.location,it);break;case 4:n.vertexAttrib4fv(X.location,it);break;default:n.vertexAttrib1fv(X.location,it)}}}}x()}function w(){L();for(let D in i){let N=i[D];for(let B in N){let C=N[B];for(let z in C){let $=C[z];for(let G in $)h($[G].object),delete $[G];delete C[z]}}delete i[D]}}function E(D){if(i[D.id]===void 0)return;let N=i[D.id];for(let B in N){let C=N[B];for(let z in C){let $=C[z];for(let G in $)h($[G].object),delete $[G];delete C[z]}}delete i[D.id]}function y(D){for(let N in i){let B=i[N];for(let C in B){let z=B[C];if(z[D.id]===void 0)continue;let $=z[D.id];for(let G in $)h($[G].object),delete $[G];delete z[D.id]}}}function M(D){for(let N in i){let B=i[N],C=D.isInstancedMesh===!0?D.id:0,z=B[C];if(z!==void 0){for(let $ in z){let G=z[$];for(let st in G)h(G[st].object),delete G[st];delete z[$]}delete B[C],Object.keys(B).length===0&&delete i[N]}}}function L(){R(),o=!0,r!==s&&(r=s,l(r.object))}function R(){s.geometry=null,s.program=null,s.wireframe=!1}return{setup:a,reset:L,resetDefaultState:R,dispose:w,releaseStatesOfGeometry:E,releaseStatesOfObject:M,releaseStatesOfProgram:y,initAttributes:_,enableAttribute:p,disableUnusedAttributes:x}}function Bw(n,t,e){let i;function s(c){i=c}function r(c,l){n.drawArrays(i,c,l),e.update(l,i,1)}function o(c,l,h){h!==0&&(n.drawArraysInstanced(i,c,l,h),e.update(l,i,h))}function a(c,l,h){if(h===0)return;t.get("WEBGL_multi_draw").multiDrawArraysWEBGL(i,c,0,l,0,h);let f=0;for(let d=0;d<h;d++)f+=l[d];e.update(f,i,1)}this.setMode=s,this.render=r,this.renderInstances=o,this.renderMultiDraw=a}function kw(n,t,e,i){let s;function r(){if(s!==void 0)return s;if(t.has("EXT_texture_filter_anisotropic")===!0){let y=t.get("EXT_texture_filter_anisotropic");s=n.getParameter(y.MAX_TEXTURE_MAX_ANISOTROPY_EXT)}else s=0;return s}function o(y){return!(y!==Gn&&i.convert(y)!==n.getParameter(n.IMPLEMENTATION_COLOR_READ_FORMAT))}function a(y){let M=y===Vn&&(t.has("EXT_color_buffer_half_float")||t.has("EXT_color_buffer_float"));return!(y!==rn&&y!==zn&&!M&&i.convert(y)!==n.getParameter(n.IMPLEMENTATION_COLOR_READ_TYPE))}function c(y){if(y==="highp"){if(n.getShaderPrecisionFormat(n.VERTEX_SHADER,n.HIGH_FLOAT).precision>0&&n.getShaderPrecisionFormat(n.FRAGMENT_SHADER,n.HIGH_FLOAT).precision>0)return"highp";y="mediump"}return y==="mediump"&&n.getShaderPrecisionFormat(n.VERTEX_SHADER,n.MEDIUM_FLOAT).precision>0&&n.getShaderPrecisionFormat(n.FRAGMENT_SHADER,n.MEDIUM_FLOAT).precision>0?"mediump":"lowp"}let l=e.precision!==void 0?e.precision:"highp",h=c(l);h!==l&&(Nt("WebGLRenderer:",l,"not supported, using",h,"instead."),l=h);let u=e.reversedDepthBuffer===!0&&t.has("EXT_clip_control"),f=e.logarithmicDepthBuffer===!0&&u===!1;e.reversedDepthBuffer===!0&&u===!1&&Nt("WebGLRenderer: Unable to use reversed depth buffer due to missing EXT_clip_control extension. Fallback to default depth buffer."),e.logarithmicDepthBuffer===!0&&u===!0&&Nt("WebGLRenderer: Logarithmic depth buffer is ignored when reversed depth buffer is enabled.");let d=n.getParameter(n.MAX_TEXTURE_IMAGE_UNITS),m=n.getParameter(n.MAX_VERTEX_TEXTURE_IMAGE_UNITS),_=n.getParameter(n.MAX_TEXTURE_SIZE),p=n.getParameter(n.MAX_CUBE_MAP_TEXTURE_SIZE),g=n.getParameter(n.MAX_VERTEX_ATTRIBS),x=n.getParameter(n.MAX_VERTEX_UNIFORM_VECTORS),b=n.getParameter(n.MAX_VARYING_VECTORS),v=n.getParameter(n.MAX_FRAGMENT_UNIFORM_VECTORS),w=n.getParameter(n.MAX_SAMPLES),E=n.getParameter(n.SAMPLES);return{isWebGL2:!0,getMaxAnisotropy:r,getMaxPrecision:c,textureFormatReadable:o,textureTypeReadable:a,precision:l,logarithmicDepthBuffer:f,reversedDepthBuffer:u,maxTextures:d,maxVertexTextures:m,maxTextureSize:_,maxCubemapSize:p,maxAttributes:g,maxVertexUniforms:x,maxVaryings:b,maxFragmentUniforms:v,maxSamples:w,samples:E}}function zw(n){let t=this,e=null,i=0,s=!1,r=!1,o=new Je,a=new Bt,c={value:null,needsUpdate:!1};this.uniform=c,this.numPlanes=0,this.numIntersection=0,this.init=function(u,f){let d=u.length!==0||f||i!==0||s;return s=f,i=u.length,d},this.beginShadows=function(){r=!0,h(null)},this.endShadows=function(){r=!1},this.setGlobalState=function(u,f){e=h(u,f,0)},this.setState=function(u,f,d){let m=u.clippingPlanes,_=u.clipIntersection,p=u.clipShadows,g=n.get(u);if(!s||m===null||m.length===0||r&&!p)r?h(null):l();else{let x=r?0:i,b=x*4,v=g.clippingState||null;c.value=v,v=h(m,f,b,d);for(let w=0;w!==b;++w)v[w]=e[w];g.clippingState=v,this.numIntersection=_?this.numPlanes:0,this.numPlanes+=x}};function l(){c.value!==e&&(c.value=e,c.needsUpdate=i>0),t.numPlanes=i,t.numIntersection=0}function h(u,f,d,m){let _=u!==null?u.length:0,p=null;if(_!==0){if(p=c.value,m!==!0||p===null){let g=d+_*4,x=f.matrixWorldInverse;a.getNormalMatrix(x),(p===null||p.length<g)&&(p=new Float32Array(g));for(let b=0,v=d;b!==_;++b,v+=4)o.copy(u[b]).applyMatrix4(x,a),o.normal.toArray(p,v),p[v+3]=o.constant}c.value=p,c.needsUpdate=!0}return t.numPlanes=_,t.numIntersection=0,p}}var ha=class extends hn{constructor(t=1,e={}){super(t,t,e),this.isWebGLCubeRenderTarget=!0;let i={width:t,height:t,depth:1},s=[i,i,i,i,i,i];this.texture=new Co(s),this._setTextureOptions(e),this.texture.isRenderTargetTexture=!0}fromEquirectangularTexture(t,e){this.texture.type=e.type,this.texture.colorSpace=e.colorSpace,this.texture.generateMipmaps=e.generateMipmaps,this.texture.minFilter=e.minFilter,this.texture.magFilter=e.magFilter;let i={uniforms:{tEquirect:{value:null}},vertexShader:`

				varying vec3 vWorldDirection;

				vec3 transformDirection( in vec3 dir, in mat4 matrix ) {

					return normalize( ( matrix * vec4( dir, 0.0 ) ).xyz );

				}

				void main() {

					vWorldDirection = transformDirection( position, modelMatrix );

					#include <begin_vertex>
					#include <project_vertex>

				}
			`,fragmentShader:`

				uniform sampler2D tEquirect;

				varying vec3 vWorldDirection;

				#include <common>

				void main() {

					vec3 direction = normalize( vWorldDirection );

					vec2 sampleUV = equirectUv( direction );

					gl_FragColor = texture2D( tEquirect, sampleUV );

				}
			`},s=new yi(5,5,5),r=new En({name:"CubemapFromEquirect",uniforms:Ds(i.uniforms),vertexShader:i.vertexShader,fragmentShader:i.fragmentShader,side:Ue,blending:Ps});r.uniforms.tEquirect.value=e;let o=new de(s,r),a=e.minFilter;return e.minFilter===bi&&(e.minFilter=Ke),new Lr(1,10,this).update(t,o),e.minFilter=a,o.geometry.dispose(),o.material.dispose(),this}clear(t,e=!0,i=!0,s=!0){let r=t.getRenderTarget();for(let o=0;o<6;o++)t.setRenderTarget(this,o),t.clear(e,i,s);t.setRenderTarget(r)}},V0=256,Vw=3,Gw=20,h_=256,u_=16,Hw=3,Ww=new P,Xw=new Gt,rh=class n{constructor(t){this._renderer=t,this._cubeSize=0,this._sourceTarget=null,this._cubeCamera=new Lr(1,10,null),this._boxMesh=new de(new yi(5,5,5),null),this._cubemapMaterial=null,this._equirectMaterial=null,this._blurMaterial=null,this._ggxMaterial=null,this._integrationMaterial=null}fromScene(t,e=0,i=.1,s=100,r={}){let{size:o=256,position:a=Ww}=r,c=this._renderer;this._setSize(o);let l=this._allocateTarget(),h=this._getSourceTarget(!0);e>0&&(h.texture.mipmapsAutoUpdate=!1);let u=c.autoClear,f=c.autoClearColor,d=c.autoClearDepth,m=c.autoClearStencil,_=t.background;c.autoClear=!0,c.autoClearColor=!0,c.autoClearDepth=!0,c.autoClearStencil=!0,_===null&&(t.background=c.getClearColor(Xw));let p=new Lr(i,s,h);return p.position.copy(a),p.update(c,t),c.autoClear=u,c.autoClearColor=f,c.autoClearDepth=d,c.autoClearStencil=m,t.background=_,e>0&&(h.texture.mipmapsAutoUpdate=!0,this._blur(l,e)),this._applyPMREM(l),l}fromEquirectangular(t,e=null){return this._fromTexture(t,e)}fromCubemap(t,e=null){return this._fromTexture(t,e)}compileCubemapShader(){this._cubemapMaterial===null&&(this._cubemapMaterial=W0(),this._compileMaterial(this._cubemapMaterial))}compileEquirectangularShader(){this._equirectMaterial===null&&(this._equirectMaterial=H0(),this._compileMaterial(this._equirectMaterial))}dispose(){this._sourceTarget!==null&&this._sourceTarget.dispose(),this._cubemapMaterial!==null&&this._cubemapMaterial.dispose(),this._equirectMaterial!==null&&this._equirectMaterial.dispose(),this._blurMaterial!==null&&this._blurMaterial.dispose(),this._ggxMaterial!==null&&this._ggxMaterial.dispose(),this._integrationMaterial!==null&&this._integrationMaterial.dispose(),this._boxMesh.geometry.dispose()}static lodToRoughness(t,e){return e>0?1-Math.sqrt(1-t/e):0}_setSize(t){this._cubeSize=Math.max(V0,Jf(t))}_fromTexture(t,e){t.mapping===Ls||t.mapping===Or?this._setSize(t.image.length===0?V0:t.image[0].width||t.image[0].image.width):this._setSize(t.image.width/4);let i=e||this._allocateTarget();return this._textureToCubemap(t),this._applyPMREM(i),i}_allocateTarget(){let t=this._cubeSize,e=G0(t,!1,!1),i=Math.log2(t)-Vw;for(let s=0;s<=i;s++)e.texture.mipmaps.push({width:t>>s,height:t>>s});return e.texture.name="PMREM",e.texture.isPMREMTexture=!0,e}_getSourceTarget(t=!1){let e=this._cubeSize,i=this._sourceTarget;return(i===null||i.width!==e||t&&i.depthBuffer===!1)&&(i!==null&&i.dispose(),this._sourceTarget=G0(e,!0,t)),this._sourceTarget}_compileMaterial(t){this._boxMesh.material=t,this._renderer.compile(this._boxMesh,this._cubeCamera.children[0])}_renderCube(t,e,i){let s=this._boxMesh,r=this._cubeCamera;s.material=i,r.renderTarget=t,r.activeMipmapLevel=e;let o=t.width>>e;t.viewport.set(0,0,o,o),r.update(this._renderer,s),t.viewport.set(0,0,t.width,t.height)}_textureToCubemap(t){let e;t.mapping===Ls||t.mapping===Or?(this._cubemapMaterial===null&&(this._cubemapMaterial=W0()),e=this._cubemapMaterial,e.uniforms.flipEnvMap.value=t.isRenderTargetTexture===!1?-1:1):(this._equirectMaterial===null&&(this._equirectMaterial=H0()),e=this._equirectMaterial),e.uniforms.envMap.value=t,this._renderCube(this._getSourceTarget(),0,e)}_applyPMREM(t){this._ggxMaterial===null&&(this._ggxMaterial=$w(),this._integrationMaterial=qw());let e=this._cubeSize,i=t.texture.mipmaps.length-1,s=this._ggxMaterial.uniforms;s.envMap.value=this._sourceTarget.texture;let r=this._integrationMaterial.uniforms;r.envMap.value=this._sourceTarget.texture,r.sourceLod.value=Math.log2(e/u_);for(let o=0;o<=i;o++){let a=n.lodToRoughness(o,i);if(o>i-Hw)r.roughness.value=a,this._renderCube(t,o,this._integrationMaterial);else{let c=a>0?Math.log2(e)+.5*Math.log2(6/(h_*Math.pow(a,4)))+.5:0;s.roughness.value=a,s.lodBias.value=c,this._renderCube(t,o,this._ggxMaterial)}}}_blur(t,e){this._blurMaterial===null&&(this._blurMaterial=Yw());let i=this._blurMaterial,s=i.uniforms,r=this._sourceTarget;s.sigma.value=Math.min(e,Math.PI)/Math.SQRT2,s.envMap.value=r.texture,this._renderCube(t,0,i),s.envMap.value=t.texture,this._renderCube(r,0,i)}};function G0(n,t,e){return new ha(n,{minFilter:bi,generateMipmaps:t,type:Vn,colorSpace:yo,depthBuffer:e})}function ua(n,t,e){return new En({name:n,uniforms:t,vertexShader:Xt.cube_vert,fragmentShader:e,side:Ue,blending:Ps,depthTest:!1,depthWrite:!1})}function $w(){return ua("PMREMGGXConvolution",{envMap:{value:null},roughness:{value:0},lodBias:{value:0}},`

		#define GGX_SAMPLES ${h_}u

		varying vec3 vWorldDirection;

		uniform samplerCube envMap;
		uniform float roughness;
		uniform float lodBias;

		#include <common>

		// Van der Corput radical inverse
		float radicalInverse_VdC( uint bits ) {

			bits = ( bits << 16u ) | ( bits >> 16u );
			bits = ( ( bits & 0x55555555u ) << 1u ) | ( ( bits & 0xAAAAAAAAu ) >> 1u );
			bits = ( ( bits & 0x33333333u ) << 2u ) | ( ( bits & 0xCCCCCCCCu ) >> 2u );
			bits = ( ( bits & 0x0F0F0F0Fu ) << 4u ) | ( ( bits & 0xF0F0F0F0u ) >> 4u );
			bits = ( ( bits & 0x00FF00FFu ) << 8u ) | ( ( bits & 0xFF00FF00u ) >> 8u );
			return float( bits ) * 2.3283064365386963e-10; // / 0x100000000

		}

		// Hammersley sequence
		vec2 hammersley( uint i, uint N ) {

			return vec2( float( i ) / float( N ), radicalInverse_VdC( i ) );

		}

		void main() {

			vec3 N = normalize( vWorldDirection );

			// For very low roughness, just sample the environment directly
			if ( roughness < 0.001 ) {

				gl_FragColor = vec4( textureLod( envMap, N, 0.0 ).rgb, 1.0 );
				return;

			}

			float alpha = roughness * roughness;
			float alpha2 = alpha * alpha;

			// Tangent space basis for VNDF sampling
			vec3 up = abs( N.z ) < 0.999 ? vec3( 0.0, 0.0, 1.0 ) : vec3( 1.0, 0.0, 0.0 );
			vec3 tangent = normalize( cross( up, N ) );
			vec3 bitangent = cross( N, tangent );

			vec3 prefilteredColor = vec3( 0.0 );
			float totalWeight = 0.0;

			for ( uint i = 0u; i < GGX_SAMPLES; i ++ ) {

				vec2 Xi = hammersley( i, GGX_SAMPLES );

				// With V = N, sample the reflected direction directly.
				float invQ = 1.0 / ( 1.0 - Xi.x + alpha2 * Xi.x );
				float NdotL = ( 1.0 - Xi.x - alpha2 * Xi.x ) * invQ;

				if ( NdotL > 0.0 ) {

					float phi = 2.0 * PI * Xi.y;
					float sinTheta = 2.0 * alpha * sqrt( Xi.x * ( 1.0 - Xi.x ) ) * invQ;
					vec3 L = N * NdotL + ( tangent * cos( phi ) + bitangent * sin( phi ) ) * sinTheta;

					// Match the source mip to the sample's solid angle. The terms
					// independent of the sample are precomputed in lodBias.
					float d = alpha2 * invQ;
					float lod = max( log2( d ) + lodBias, 0.0 );

					// Weight by NdotL for the split-sum approximation
					prefilteredColor += textureLod( envMap, L, lod ).rgb * NdotL;
					totalWeight += NdotL;

				}

			}

			gl_FragColor = vec4( prefilteredColor / totalWeight, 1.0 );

		}
	`)}function qw(){return ua("PMREMGGXIntegration",{envMap:{value:null},roughness:{value:0},sourceLod:{value:0},sourceSize:{value:u_}},`

		varying vec3 vWorldDirection;

		uniform samplerCube envMap;
		uniform float roughness;
		uniform float sourceLod;
		uniform int sourceSize;

		void main() {

			vec3 N = normalize( vWorldDirection );

			float alpha = roughness * roughness;
			float alpha2 = alpha * alpha;

			float texelSize = 2.0 / float( sourceSize );

			vec3 prefilteredColor = vec3( 0.0 );
			float totalWeight = 0.0;

			// Pair opposite texels: only the one in N's hemisphere contributes.
			for ( int face = 0; face < 3; face ++ ) {

				for ( int y = 0; y < sourceSize; y ++ ) {

					for ( int x = 0; x < sourceSize; x ++ ) {

						vec2 uv = ( vec2( x, y ) + 0.5 ) * texelSize - 1.0;
						vec3 texelDirection = face == 0 ? vec3( 1.0, uv ) : ( face == 1 ? vec3( uv.x, 1.0, uv.y ) : vec3( uv, 1.0 ) );

						float invDistance = inversesqrt( 1.0 + dot( uv, uv ) );
						float NdotL = dot( N, texelDirection );
						texelDirection *= NdotL < 0.0 ? - 1.0 : 1.0;
						NdotL = abs( NdotL ) * invDistance;

						// With V = N, NdotH squared is ( 1 + NdotL ) / 2. Common factors
						// in the GGX distribution and texel solid angle cancel when normalized.
						float d = 1.0 + alpha2 + ( alpha2 - 1.0 ) * NdotL;
						float weight = NdotL * invDistance * invDistance * invDistance / ( d * d );

						prefilteredColor += textureLod( envMap, texelDirection, sourceLod ).rgb * weight;
						totalWeight += weight;

					}

				}

			}

			gl_FragColor = vec4( prefilteredColor / totalWeight, 1.0 );

		}
	`)}function Yw(){return ua("PMREMSphericalGaussianBlur",{envMap:{value:null},sigma:{value:0}},`

		#define SAMPLES ${Gw}
		#define GOLDEN_ANGLE 2.39996322973

		varying vec3 vWorldDirection;

		uniform samplerCube envMap;
		uniform float sigma;

		#include <common>

		void main() {

			vec3 outputDirection = normalize( vWorldDirection );

			vec3 up = abs( outputDirection.z ) < 0.999 ? vec3( 0.0, 0.0, 1.0 ) : vec3( 1.0, 0.0, 0.0 );
			vec3 tangent = normalize( cross( up, outputDirection ) );
			vec3 bitangent = cross( outputDirection, tangent );

			// Truncate the kernel at three standard deviations or at the antipode.
			float thetaMax = min( 3.0 * sigma, PI );
			float truncation = 1.0 - exp( - 0.5 * thetaMax * thetaMax / ( sigma * sigma ) );

			vec3 accumColor = vec3( 0.0 );
			float accumWeight = 0.0;

			for ( int i = 0; i < SAMPLES; i ++ ) {

				// Stratified inverse-CDF sampling of the Gaussian, placed on a golden-angle spiral.
				float stratum = ( float( i ) + 0.5 ) / float( SAMPLES );
				float theta = sigma * sqrt( - 2.0 * log( 1.0 - stratum * truncation ) );
				float phi = float( i ) * GOLDEN_ANGLE;

				vec3 offset = cos( phi ) * tangent + sin( phi ) * bitangent;
				vec3 sampleDirection = cos( theta ) * outputDirection + sin( theta ) * offset;

				// Correct the planar sample density to solid angle.
				float weight = sin( theta ) / theta;

				accumColor += weight * textureLod( envMap, sampleDirection, 0.0 ).rgb;
				accumWeight += weight;

			}

			gl_FragColor = vec4( accumColor / accumWeight, 1.0 );

		}
	`)}function H0(){return ua("PMREMEquirectangularToCubemap",{envMap:{value:null}},`

		varying vec3 vWorldDirection;

		uniform sampler2D envMap;

		#include <common>

		void main() {

			// Average four subpixel samples to preserve small, bright features.
			vec3 direction = normalize( vWorldDirection );
			vec3 dx = dFdx( direction ) * 0.25;
			vec3 dy = dFdy( direction ) * 0.25;

			vec3 color = textureLod( envMap, equirectUv( normalize( direction - dx - dy ) ), 0.0 ).rgb;
			color += textureLod( envMap, equirectUv( normalize( direction + dx - dy ) ), 0.0 ).rgb;
			color += textureLod( envMap, equirectUv( normalize( direction - dx + dy ) ), 0.0 ).rgb;
			color += textureLod( envMap, equirectUv( normalize( direction + dx + dy ) ), 0.0 ).rgb;
			gl_FragColor = vec4( color * 0.25, 1.0 );

		}
	`)}function W0(){return ua("PMREMCubemapToCubemap",{envMap:{value:null},flipEnvMap:{value:-1}},`

		varying vec3 vWorldDirection;

		uniform samplerCube envMap;
		uniform float flipEnvMap;

		void main() {

			gl_FragColor = vec4( textureCube( envMap, vec3( flipEnvMap * vWorldDirection.x, vWorldDirection.yz ) ).rgb, 1.0 );

		}
	`)}function Zw(n){let t=new WeakMap,e=new WeakMap,i=null;function s(f,d=!1){return f==null?null:d?o(f):r(f)}function r(f){if(f&&f.isTexture){let d=f.mapping;if(d===gc||d===_c)if(t.has(f)){let m=t.get(f).texture;return a(m,f.mapping)}else{let m=f.image;if(m&&m.height>0){let _=new ha(m.height);return _.fromEquirectangularTexture(n,f),t.set(f,_),f.addEventListener("dispose",l),a(_.texture,f.mapping)}else return null}}return f}function o(f){if(f&&f.isTexture&&f.isPMREMTexture!==!0){let d=f.mapping,m=d===gc||d===_c,_=d===Ls||d===Or;if(m||_){let p=e.get(f),g=p!==void 0?p.texture.pmremVersion:0;if(f.isRenderTargetTexture&&f.pmremVersion!==g)return i===null&&(i=new rh(n)),p=m?i.fromEquirectangular(f,p):i.fromCubemap(f,p),p.texture.pmremVersion=f.pmremVersion,e.set(f,p),p.texture;if(p!==void 0)return p.texture;{let x=f.image;return m&&x&&x.height>0||_&&x&&c(x)?(i===null&&(i=new rh(n)),p=m?i.fromEquirectangular(f):i.fromCubemap(f),p.texture.pmremVersion=f.pmremVersion,e.set(f,p),f.addEventListener("dispose",h),p.texture):null}}}return f}function a(f,d){return d===gc?f.mapping=Ls:d===_c&&(f.mapping=Or),f}function c(f){let d=0,m=6;for(let _=0;_<m;_++)f[_]!==void 0&&d++;return d===m}function l(f){let d=f.target;d.removeEventListener("dispose",l);let m=t.get(d);m!==void 0&&(t.delete(d),m.dispose())}function h(f){let d=f.target;d.removeEventListener("dispose",h);let m=e.get(d);m!==void 0&&(e.delete(d),m.dispose())}function u(){t=new WeakMap,e=new WeakMap,i!==null&&(i.dispose(),i=null)}return{get:s,dispose:u}}function Jw(n){let t={};function e(i){if(t[i]!==void 0)return t[i];let s=n.getExtension(i);return t[i]=s,s}return{has:function(i){return e(i)!==null},init:function(){e("EXT_color_buffer_float"),e("WEBGL_clip_cull_distance"),e("OES_texture_float_linear"),e("EXT_color_buffer_half_float"),e("WEBGL_multisampled_render_to_texture"),e("WEBGL_render_shared_exponent")},get:function(i){let s=e(i);return s===null&&po("WebGLRenderer: "+i+" extension not supported."),s}}}function jw(n,t,e,i){let s={},r=new WeakMap,o=new FinalizationRegistry(m=>delete s[m]);function a(m){c(m.target)}function c(m){m.index!==null&&t.remove(m.index);for(let p in m.attributes)t.remove(m.attributes[p]);m.removeEventListener("dispose",a),delete s[m.id],o.unregister(m);let _=r.get(m);_&&(t.remove(_),r.delete(m)),i.releaseStatesOfGeometry(m),m.isInstancedBufferGeometry===!0&&delete m._maxInstanceCount,e.memory.geometries--}function l(m,_){return s[_.id]!==void 0||(_.addEventListener("dispose",a),s[_.id]=new WeakRef(_),o.register(_,_.id,_),e.memory.geometries++),_}function h(m){let _=m.attributes;for(let p in _)t.update(_[p],n.ARRAY_BUFFER)}function u(m){let _=m.index,p=m.attributes.position,g=0;if(p===void 0)return;let x=_!==null?_.array.length:p.array.length/3-1,b=p.count>=65535?Eo:Ao,v=new b(Math.ceil(x/3)*6,1),w=v.array;if(_!==null){let y=_.array;g=_.version;for(let M=0,L=0;M<x;M+=3){let R=y[M+0],D=y[M+1],N=y[M+2];w[L++]=R,w[L++]=D,w[L++]=D,w[L++]=N,w[L++]=N,w[L++]=R}}else{g=p.version;for(let y=0,M=0;y<x;y+=3){let L=y+0,R=y+1,D=y+2;w[M++]=L,w[M++]=R,w[M++]=R,w[M++]=D,w[M++]=D,w[M++]=L}}v.version=g;let E=r.get(m);E&&t.remove(E),r.set(m,v)}function f(m){let _=r.get(m);if(_){let p=m.index;p!==null&&_.version<p.version&&u(m)}else u(m);return r.get(m)}function d(){for(let m in s){let _=s[m].deref();_!==void 0&&c(_)}}return{get:l,update:h,getWireframeAttribute:f,dispose:d}}function Kw(n,t,e){let i;function s(u){i=u}let r,o;function a(u){r=u.type,o=u.bytesPerElement}function c(u,f){n.drawElements(i,f,r,u*o),e.update(f,i,1)}function l(u,f,d){d!==0&&(n.drawElementsInstanced(i,f,r,u*o,d),e.update(f,i,d))}function h(u,f,d){if(d===0)return;t.get("WEBGL_multi_draw").multiDrawElementsWEBGL(i,f,0,r,u,0,d);let _=0;for(let p=0;p<d;p++)_+=f[p];e.update(_,i,1)}this.setMode=s,this.setIndex=a,this.render=c,this.renderInstances=l,this.renderMultiDraw=h}function Qw(n){let t={geometries:0,textures:0},e={frame:0,calls:0,triangles:0,points:0,lines:0};function i(r,o,a){switch(e.calls++,o){case n.TRIANGLES:e.triangles+=a*(r/3);break;case n.LINES:e.lines+=a*(r/2);break;case n.LINE_STRIP:e.lines+=a*(r-1);break;case n.LINE_LOOP:e.lines+=a*r;break;case n.POINTS:e.points+=a*r;break;default:Ot("WebGLInfo: Unknown draw mode:",o);break}}function s(){e.calls=0,e.triangles=0,e.points=0,e.lines=0}return{memory:t,render:e,programs:null,autoReset:!0,reset:s,update:i}}function t1(n,t,e){let i=new WeakMap,s=new oe;function r(o,a,c){let l=o.morphTargetInfluences,h=a.morphAttributes.position||a.morphAttributes.normal||a.morphAttributes.color,u=h!==void 0?h.length:0,f=i.get(a);if(f===void 0||f.count!==u){let L=function(){y.dispose(),i.delete(a),a.removeEventListener("dispose",L)};f!==void 0&&f.texture.dispose();let d=a.morphAttributes.position!==void 0,m=a.morphAttributes.normal!==void 0,_=a.morphAttributes.color!==void 0,p=a.morphAttributes.position||[],g=a.morphAttributes.normal||[],x=a.morphAttributes.color||[],b=0;d===!0&&(b=1),m===!0&&(b=2),_===!0&&(b=3);let v=a.attributes.position.count*b,w=1;v>t.maxTextureSize&&(w=Math.ceil(v/t.maxTextureSize),v=t.maxTextureSize);let E=new Float32Array(v*w*4*u),y=new So(E,v,w,u);y.type=zn,y.needsUpdate=!0;let M=b*4;for(let R=0;R<u;R++){let D=p[R],N=g[R],B=x[R],C=v*w*4*R;for(let z=0;z<D.count;z++){let $=z*M;d===!0&&(s.fromBufferAttribute(D,z),E[C+$+0]=s.x,E[C+$+1]=s.y,E[C+$+2]=s.z,E[C+$+3]=0),m===!0&&(s.fromBufferAttribute(N,z),E[C+$+4]=s.x,E[C+$+5]=s.y,E[C+$+6]=s.z,E[C+$+7]=0),_===!0&&(s.fromBufferAttribute(B,z),E[C+$+8]=s.x,E[C+$+9]=s.y,E[C+$+10]=s.z,E[C+$+11]=B.itemSize===4?s.w:1)}}f={count:u,texture:y,size:new ht(v,w)},i.set(a,f),a.addEventListener("dispose",L)}if(o.isInstancedMesh===!0&&o.morphTexture!==null)c.getUniforms().setValue(n,"morphTexture",o.morphTexture,e);else{let d=0;for(let _=0;_<l.length;_++)d+=l[_];let m=a.morphTargetsRelative?1:1-d;c.getUniforms().setValue(n,"morphTargetBaseInfluence",m),c.getUniforms().setValue(n,"morphTargetInfluences",l)}c.getUniforms().setValue(n,"morphTargetsTexture",f.texture,e),c.getUniforms().setValue(n,"morphTargetsTextureSize",f.size)}return{update:r}}function e1(n,t,e,i,s){let r=new WeakMap;function o(l){let h=s.render.frame,u=l.geometry,f=t.get(l,u);if(r.get(f)!==h&&(t.update(f),r.set(f,h)),l.isInstancedMesh&&(l.hasEventListener("dispose",c)===!1&&l.addEventListener("dispose",c),r.get(l)!==h&&(e.update(l.instanceMatrix,n.ARRAY_BUFFER),l.instanceColor!==null&&e.update(l.instanceColor,n.ARRAY_BUFFER),r.set(l,h))),l.isSkinnedMesh){let d=l.skeleton;r.get(d)!==h&&(d.update(),r.set(d,h))}return f}function a(){r=new WeakMap}function c(l){let h=l.target;h.removeEventListener("dispose",c),i.releaseStatesOfObject(h),e.remove(h.instanceMatrix),h.instanceColor!==null&&e.remove(h.instanceColor)}return{update:o,dispose:a}}var n1={[Rf]:"LINEAR_TONE_MAPPING",[Pf]:"REINHARD_TONE_MAPPING",[If]:"CINEON_TONE_MAPPING",[Lf]:"ACES_FILMIC_TONE_MAPPING",[Df]:"AGX_TONE_MAPPING",[Uf]:"NEUTRAL_TONE_MAPPING",[Nf]:"CUSTOM_TONE_MAPPING"};function i1(n,t,e,i,s,r){let o=new hn(t,e,{type:n,depthBuffer:s,stencilBuffer:r,samples:i?4:0,storeMultisampledDepthBuffer:!1,storeMultisampledStencilBuffer:!1,resolveDepthBuffer:!1,resolveStencilBuffer:!1}),a=null,c=null,l=null,h=new ae;h.setAttribute("position",new Vt([-1,3,0,-1,-1,0,3,-1,0],3)),h.setAttribute("uv",new Vt([0,2,0,0,2,0],2));let u=new tc({uniforms:{tDiffuse:{value:null}},vertexShader:`
			precision highp float;

			uniform mat4 modelViewMatrix;
			uniform mat4 projectionMatrix;

			attribute vec3 position;
			attribute vec2 uv;

			varying vec2 vUv;

			void main() {
				vUv = uv;
				gl_Position = projectionMatrix * modelViewMatrix * vec4( position, 1.0 );
			}`,fragmentShader:`
			precision highp float;

			uniform sampler2D tDiffuse;

			varying vec2 vUv;

			#include <tonemapping_pars_fragment>
			#include <colorspace_pars_fragment>

			void main() {
				gl_FragColor = texture2D( tDiffuse, vUv );

				#ifdef LINEAR_TONE_MAPPING
					gl_FragColor.rgb = LinearToneMapping( gl_FragColor.rgb );
				#elif defined( REINHARD_TONE_MAPPING )
					gl_FragColor.rgb = ReinhardToneMapping( gl_FragColor.rgb );
				#elif defined( CINEON_TONE_MAPPING )
					gl_FragColor.rgb = CineonToneMapping( gl_FragColor.rgb );
				#elif defined( ACES_FILMIC_TONE_MAPPING )
					gl_FragColor.rgb = ACESFilmicToneMapping( gl_FragColor.rgb );
				#elif defined( AGX_TONE_MAPPING )
					gl_FragColor.rgb = AgXToneMapping( gl_FragColor.rgb );
				#elif defined( NEUTRAL_TONE_MAPPING )
					gl_FragColor.rgb = NeutralToneMapping( gl_FragColor.rgb );
				#elif defined( CUSTOM_TONE_MAPPING )
					gl_FragColor.rgb = CustomToneMapping( gl_FragColor.rgb );
				#endif

				#ifdef SRGB_TRANSFER
					gl_FragColor = sRGBTransferOETF( gl_FragColor );
				#endif
			}`,depthTest:!1,depthWrite:!1}),f=new de(h,u),d=new Xo(-1,1,1,-1,0,1),m=null,_=null,p=!1,g,x=null,b=[],v=!1;this.setSize=function(w,E){o.setSize(w,E),a!==null&&a.setSize(w,E),c!==null&&c.setSize(w,E);for(let y=0;y<b.length;y++){let M=b[y];M.setSize&&M.setSize(w,E)}},this.setEffects=function(w){b=w,v=b.length>0&&b[0].isRenderPass===!0;let E=o.width,y=o.height;b.length>0&&a===null&&(a=new hn(E,y,{type:Vn,depthBuffer:!1,stencilBuffer:!1}),c=new hn(E,y,{type:Vn,depthBuffer:!1,stencilBuffer:!1}));let M=s===!0&&b.some(L=>L.needsDepthTexture===!0);M!==(o.depthTexture!==null)&&(M===!0&&l===null&&(l=new xi(E,y),r===!0&&(l.format=Mi,l.type=Ns)),o.dispose(),o.depthTexture=M?l:null,o.resolveDepthBuffer=M,o.storeMultisampledDepthBuffer=M);for(let L=0;L<b.length;L++){let R=b[L];R.setSize&&R.setSize(E,y),M&&R.needsDepthTexture===!0&&R.setDepthTexture&&R.setDepthTexture(l)}},this.begin=function(w,E){if(p||w.toneMapping===Jn&&b.length===0)return!1;if(x=E,E!==null){let y=E.width,M=E.height;(o.width!==y||o.height!==M)&&this.setSize(y,M)}return v===!1&&w.setRenderTarget(o),g=w.toneMapping,w.toneMapping=Jn,!0},this.hasRenderPass=function(){return v},this.end=function(w,E){w.toneMapping=g,p=!0;let y=o,M=a;for(let L=0;L<b.length;L++){let R=b[L];R.enabled!==!1&&(R.render(w,M,y,E),R.needsSwap!==!1&&(y=M,M=M===a?c:a))}if(m!==w.outputColorSpace||_!==w.toneMapping){m=w.outputColorSpace,_=w.toneMapping,u.defines={},Jt.getTransfer(m)===se&&(u.defines.SRGB_TRANSFER="");let L=n1[_];L&&(u.defines[L]=""),u.needsUpdate=!0}u.uniforms.tDiffuse.value=y.texture,w.setRenderTarget(x),w.render(f,d),x=null,p=!1},this.isCompositing=function(){return p},this.dispose=function(){o.dispose(),a!==null&&a.dispose(),c!==null&&c.dispose(),h.dispose(),u.dispose()}}var f_=new Qe,d_=new xi(1,1),p_=new Ro(1),m_=new So,g_=new Vl,__=new Co,X0=[],$0=[],q0=new Float32Array(16),Y0=new Float32Array(9),Z0=new Float32Array(4);function kr(n,t,e){let i=n[0];if(i<=0||i>0)return n;let s=t*e,r=X0[s];if(r===void 0&&(r=new Float32Array(s),X0[s]=r),t!==0){i.toArray(r,0);for(let o=1,a=0;o!==t;++o)a+=e,n[o].toArray(r,a)}return r}function Se(n,t){if(n.length!==t.length)return!1;for(let e=0,i=n.length;e<i;e++)if(n[e]!==t[e])return!1;return!0}function we(n,t){for(let e=0,i=t.length;e<i;e++)n[e]=t[e]}function ah(n,t){let e=$0[t];e===void 0&&(e=new Int32Array(t),$0[t]=e);for(let i=0;i!==t;++i)e[i]=n.allocateTextureUnit();return e}function s1(n,t){let e=this.cache;e[0]!==t&&(n.uniform1f(this.addr,t),e[0]=t)}function r1(n,t){let e=this.cache;if(t.x!==void 0)(e[0]!==t.x||e[1]!==t.y)&&(n.uniform2f(this.addr,t.x,t.y),e[0]=t.x,e[1]=t.y);else{if(Se(e,t))return;n.uniform2fv(this.addr,t),we(e,t)}}function o1(n,t){let e=this.cache;if(t.x!==void 0)(e[0]!==t.x||e[1]!==t.y||e[2]!==t.z)&&(n.uniform3f(this.addr,t.x,t.y,t.z),e[0]=t.x,e[1]=t.y,e[2]=t.z);else if(t.r!==void 0)(e[0]!==t.r||e[1]!==t.g||e[2]!==t.b)&&(n.uniform3f(this.addr,t.r,t.g,t.b),e[0]=t.r,e[1]=t.g,e[2]=t.b);else{if(Se(e,t))return;n.uniform3fv(this.addr,t),we(e,t)}}function a1(n,t){let e=this.cache;if(t.x!==void 0)(e[0]!==t.x||e[1]!==t.y||e[2]!==t.z||e[3]!==t.w)&&(n.uniform4f(this.addr,t.x,t.y,t.z,t.w),e[0]=t.x,e[1]=t.y,e[2]=t.z,e[3]=t.w);else{if(Se(e,t))return;n.uniform4fv(this.addr,t),we(e,t)}}function l1(n,t){let e=this.cache,i=t.elements;if(i===void 0){if(Se(e,t))return;n.uniformMatrix2fv(this.addr,!1,t),we(e,t)}else{if(Se(e,i))return;Z0.set(i),n.uniformMatrix2fv(this.addr,!1,Z0),we(e,i)}}function c1(n,t){let e=this.cache,i=t.elements;if(i===void 0){if(Se(e,t))return;n.uniformMatrix3fv(this.addr,!1,t),we(e,t)}else{if(Se(e,i))return;Y0.set(i),n.uniformMatrix3fv(this.addr,!1,Y0),we(e,i)}}function h1(n,t){let e=this.cache,i=t.elements;if(i===void 0){if(Se(e,t))return;n.uniformMatrix4fv(this.addr,!1,t),we(e,t)}else{if(Se(e,i))return;q0.set(i),n.uniformMatrix4fv(this.addr,!1,q0),we(e,i)}}function u1(n,t){let e=this.cache;e[0]!==t&&(n.uniform1i(this.addr,t),e[0]=t)}function f1(n,t){let e=this.cache;if(t.x!==void 0)(e[0]!==t.x||e[1]!==t.y)&&(n.uniform2i(this.addr,t.x,t.y),e[0]=t.x,e[1]=t.y);else{if(Se(e,t))return;n.uniform2iv(this.addr,t),we(e,t)}}function d1(n,t){let e=this.cache;if(t.x!==void 0)(e[0]!==t.x||e[1]!==t.y||e[2]!==t.z)&&(n.uniform3i(this.addr,t.x,t.y,t.z),e[0]=t.x,e[1]=t.y,e[2]=t.z);else{if(Se(e,t))return;n.uniform3iv(this.addr,t),we(e,t)}}function p1(n,t){let e=this.cache;if(t.x!==void 0)(e[0]!==t.x||e[1]!==t.y||e[2]!==t.z||e[3]!==t.w)&&(n.uniform4i(this.addr,t.x,t.y,t.z,t.w),e[0]=t.x,e[1]=t.y,e[2]=t.z,e[3]=t.w);else{if(Se(e,t))return;n.uniform4iv(this.addr,t),we(e,t)}}function m1(n,t){let e=this.cache;e[0]!==t&&(n.uniform1ui(this.addr,t),e[0]=t)}function g1(n,t){let e=this.cache;if(t.x!==void 0)(e[0]!==t.x||e[1]!==t.y)&&(n.uniform2ui(this.addr,t.x,t.y),e[0]=t.x,e[1]=t.y);else{if(Se(e,t))return;n.uniform2uiv(this.addr,t),we(e,t)}}function _1(n,t){let e=this.cache;if(t.x!==void 0)(e[0]!==t.x||e[1]!==t.y||e[2]!==t.z)&&(n.uniform3ui(this.addr,t.x,t.y,t.z),e[0]=t.x,e[1]=t.y,e[2]=t.z);else{if(Se(e,t))return;n.uniform3uiv(this.addr,t),we(e,t)}}function x1(n,t){let e=this.cache;if(t.x!==void 0)(e[0]!==t.x||e[1]!==t.y||e[2]!==t.z||e[3]!==t.w)&&(n.uniform4ui(this.addr,t.x,t.y,t.z,t.w),e[0]=t.x,e[1]=t.y,e[2]=t.z,e[3]=t.w);else{if(Se(e,t))return;n.uniform4uiv(this.addr,t),we(e,t)}}function lh(n){return n.version===0&&(n.compareFunction=$f,n.needsUpdate=!0),n}function y1(n,t,e){let i=this.cache,s=e.allocateTextureUnit();i[0]!==s&&(n.uniform1i(this.addr,s),i[0]=s);let r;this.type===n.SAMPLER_2D_SHADOW?r=lh(d_):r=f_,e.setTexture2D(t||r,s)}function v1(n,t,e){let i=this.cache,s=e.allocateTextureUnit();i[0]!==s&&(n.uniform1i(this.addr,s),i[0]=s),e.setTexture3D(t||g_,s)}function b1(n,t,e){let i=this.cache,s=e.allocateTextureUnit();i[0]!==s&&(n.uniform1i(this.addr,s),i[0]=s);let r;this.type===n.SAMPLER_CUBE_SHADOW?r=lh(p_):r=__,e.setTextureCube(t||r,s)}function M1(n,t,e){let i=this.cache,s=e.allocateTextureUnit();i[0]!==s&&(n.uniform1i(this.addr,s),i[0]=s),e.setTexture2DArray(t||m_,s)}function S1(n){switch(n){case 5126:return s1;case 35664:return r1;case 35665:return o1;case 35666:return a1;case 35674:return l1;case 35675:return c1;case 35676:return h1;case 5124:case 35670:return u1;case 35667:case 35671:return f1;case 35668:case 35672:return d1;case 35669:case 35673:return p1;case 5125:return m1;case 36294:return g1;case 36295:return _1;case 36296:return x1;case 35678:case 36198:case 36298:case 36306:case 35682:return y1;case 35679:case 36299:case 36307:return v1;case 35680:case 36300:case 36308:case 36293:return b1;case 36289:case 36303:case 36311:case 36292:return M1}}function w1(n,t){n.uniform1fv(this.addr,t)}function A1(n,t){let e=kr(t,this.size,2);n.uniform2fv(this.addr,e)}function E1(n,t){let e=kr(t,this.size,3);n.uniform3fv(this.addr,e)}function T1(n,t){let e=kr(t,this.size,4);n.uniform4fv(this.addr,e)}function C1(n,t){let e=kr(t,this.size,4);n.uniformMatrix2fv(this.addr,!1,e)}function R1(n,t){let e=kr(t,this.size,9);n.uniformMatrix3fv(this.addr,!1,e)}function P1(n,t){let e=kr(t,this.size,16);n.uniformMatrix4fv(this.addr,!1,e)}function I1(n,t){n.uniform1iv(this.addr,t)}function L1(n,t){n.uniform2iv(this.addr,t)}function N1(n,t){n.uniform3iv(this.addr,t)}function D1(n,t){n.uniform4iv(this.addr,t)}function U1(n,t){n.uniform1uiv(this.addr,t)}function O1(n,t){n.uniform2uiv(this.addr,t)}function F1(n,t){n.uniform3uiv(this.addr,t)}function B1(n,t){n.uniform4uiv(this.addr,t)}function k1(n,t,e){let i=this.cache,s=t.length,r=ah(e,s);Se(i,r)||(n.uniform1iv(this.addr,r),we(i,r));let o;this.type===n.SAMPLER_2D_SHADOW?o=lh(d_):o=f_;for(let a=0;a!==s;++a)e.setTexture2D(t[a]||o,r[a])}function z1(n,t,e){let i=this.cache,s=t.length,r=ah(e,s);Se(i,r)||(n.uniform1iv(this.addr,r),we(i,r));for(let o=0;o!==s;++o)e.setTexture3D(t[o]||g_,r[o])}function V1(n,t,e){let i=this.cache,s=t.length,r=ah(e,s);Se(i,r)||(n.uniform1iv(this.addr,r),we(i,r));let o;this.type===n.SAMPLER_CUBE_SHADOW?o=lh(p_):o=__;for(let a=0;a!==s;++a)e.setTextureCube(t[a]||o,r[a])}function G1(n,t,e){let i=this.cache,s=t.length,r=ah(e,s);Se(i,r)||(n.uniform1iv(this.addr,r),we(i,r));for(let o=0;o!==s;++o)e.setTexture2DArray(t[o]||m_,r[o])}function H1(n){switch(n){case 5126:return w1;case 35664:return A1;case 35665:return E1;case 35666:return T1;case 35674:return C1;case 35675:return R1;case 35676:return P1;case 5124:case 35670:return I1;case 35667:case 35671:return L1;case 35668:case 35672:return N1;case 35669:case 35673:return D1;case 5125:return U1;case 36294:return O1;case 36295:return F1;case 36296:return B1;case 35678:case 36198:case 36298:case 36306:case 35682:return k1;case 35679:case 36299:case 36307:return z1;case 35680:case 36300:case 36308:case 36293:return V1;case 36289:case 36303:case 36311:case 36292:return G1}}var od=class{constructor(t,e,i){this.id=t,this.addr=i,this.cache=[],this.type=e.type,this.setValue=S1(e.type)}},ad=class{constructor(t,e,i){this.id=t,this.addr=i,this.cache=[],this.type=e.type,this.size=e.size,this.setValue=H1(e.type)}},ld=class{constructor(t){this.id=t,this.seq=[],this.map={}}setValue(t,e,i){let s=this.seq;for(let r=0,o=s.length;r!==o;++r){let a=s[r];a.setValue(t,e[a.id],i)}}},sd=/(\w+)(\])?(\[|\.)?/g;function J0(n,t){n.seq.push(t),n.map[t.id]=t}function W1(n,t,e){let i=n.name,s=i.length;for(sd.lastIndex=0;;){let r=sd.exec(i),o=sd.lastIndex,a=r[1],c=r[2]==="]",l=r[3];if(c&&(a=a|0),l===void 0||l==="["&&o+2===s){J0(e,l===void 0?new od(a,n,t):new ad(a,n,t));break}else{let u=e.map[a];u===void 0&&(u=new ld(a),J0(e,u)),e=u}}}var Br=class{constructor(t,e){this.seq=[],this.map={};let i=t.getProgramParameter(e,t.ACTIVE_UNIFORMS);for(let o=0;o<i;++o){let a=t.getActiveUniform(e,o),c=t.getUniformLocation(e,a.name);W1(a,c,this)}let s=[],r=[];for(let o of this.seq)o.type===t.SAMPLER_2D_SHADOW||o.type===t.SAMPLER_CUBE_SHADOW||o.type===t.SAMPLER_2D_ARRAY_SHADOW?s.push(o):r.push(o);s.length>0&&(this.seq=s.concat(r))}setValue(t,e,i,s){let r=this.map[e];r!==void 0&&r.setValue(t,i,s)}setOptional(t,e,i){let s=e[i];s!==void 0&&this.setValue(t,i,s)}static upload(t,e,i,s){for(let r=0,o=e.length;r!==o;++r){let a=e[r],c=i[a.id];c.needsUpdate!==!1&&a.setValue(t,c.value,s)}}static seqWithValue(t,e){let i=[];for(let s=0,r=t.length;s!==r;++s){let o=t[s];o.id in e&&i.push(o)}return i}};function j0(n,t,e){let i=n.createShader(t);return n.shaderSource(i,e),n.compileShader(i),i}var X1=37297,$1=0;function q1(n,t){let e=n.split(`
`),i=[],s=Math.max(t-6,0),r=Math.min(t+6,e.length);for(let o=s;o<r;o++){let a=o+1;i.push(`${a===t?">":" "} ${a}: ${e[o]}`)}return i.join(`
`)}var K0=new Bt;function Y1(n){Jt._getMatrix(K0,Jt.workingColorSpace,n);let t=`mat3( ${K0.elements.map(e=>e.toFixed(4))} )`;switch(Jt.getTransfer(n)){case vo:return[t,"LinearTransferOETF"];case se:return[t,"sRGBTransferOETF"];default:return Nt("WebGLProgram: Unsupported color space: ",n),[t,"LinearTransferOETF"]}}function Q0(n,t,e){let i=n.getShaderParameter(t,n.COMPILE_STATUS),r=(n.getShaderInfoLog(t)||"").trim();if(i&&r==="")return"";let o=/ERROR: 0:(\d+)/.exec(r);if(o){let a=parseInt(o[1]);return e.toUpperCase()+`

`+r+`

`+q1(n.getShaderSource(t),a)}else return r}function Z1(n,t){let e=Y1(t);return[`vec4 ${n}( vec4 value ) {`,`	return ${e[1]}( vec4( ${e[0]} * value.rgb, value.a ) );`,"}"].join(`
`)}var J1={[Rf]:"Linear",[Pf]:"Reinhard",[If]:"Cineon",[Lf]:"ACESFilmic",[Df]:"AgX",[Uf]:"Neutral",[Nf]:"Custom"};function j1(n,t){let e=J1[t];return e===void 0?(Nt("WebGLProgram: Unsupported toneMapping:",t),"vec3 "+n+"( vec3 color ) { return LinearToneMapping( color ); }"):"vec3 "+n+"( vec3 color ) { return "+e+"ToneMapping( color ); }"}var sh=new P;function K1(){Jt.getLuminanceCoefficients(sh);let n=sh.x.toFixed(4),t=sh.y.toFixed(4),e=sh.z.toFixed(4);return["float luminance( const in vec3 rgb ) {",`	const vec3 weights = vec3( ${n}, ${t}, ${e} );`,"	return dot( weights, rgb );","}"].join(`
`)}function Q1(n){return[n.extensionClipCullDistance?"#extension GL_ANGLE_clip_cull_distance : require":"",n.extensionMultiDraw?"#extension GL_ANGLE_multi_draw : require":""].filter(ca).join(`
`)}function tA(n){let t=[];for(let e in n){let i=n[e];i!==!1&&t.push("#define "+e+" "+i)}return t.join(`
`)}function eA(n,t){let e={},i=n.getProgramParameter(t,n.ACTIVE_ATTRIBUTES);for(let s=0;s<i;s++){let r=n.getActiveAttrib(t,s),o=r.name,a=1;r.type===n.FLOAT_MAT2&&(a=2),r.type===n.FLOAT_MAT3&&(a=3),r.type===n.FLOAT_MAT4&&(a=4),e[o]={type:r.type,location:n.getAttribLocation(t,o),locationSize:a}}return e}function ca(n){return n!==""}function t_(n,t){let e=t.numSpotLightShadows+t.numSpotLightMaps-t.numSpotLightShadowsWithMaps;return n.replace(/NUM_SUN_LIGHTS/g,t.numSunLights).replace(/NUM_DIR_LIGHTS/g,t.numDirLights).replace(/NUM_SPOT_LIGHTS/g,t.numSpotLights).replace(/NUM_SPOT_LIGHT_MAPS/g,t.numSpotLightMaps).replace(/NUM_SPOT_LIGHT_COORDS/g,e).replace(/NUM_RECT_AREA_LIGHTS/g,t.numRectAreaLights).replace(/NUM_POINT_LIGHTS/g,t.numPointLights).replace(/NUM_HEMI_LIGHTS/g,t.numHemiLights).replace(/NUM_SUN_LIGHT_SHADOWS/g,t.numSunLightShadows).replace(/NUM_DIR_LIGHT_SHADOWS/g,t.numDirLightShadows).replace(/NUM_SPOT_LIGHT_SHADOWS_WITH_MAPS/g,t.numSpotLightShadowsWithMaps).replace(/NUM_SPOT_LIGHT_SHADOWS/g,t.numSpotLightShadows).replace(/NUM_POINT_LIGHT_SHADOWS/g,t.numPointLightShadows).replace(/NUM_LIGHT_PROBE_GRIDS/g,t.numLightProbeGrids)}function e_(n,t){return n.replace(/NUM_CLIPPING_PLANES/g,t.numClippingPlanes).replace(/UNION_CLIPPING_PLANES/g,t.numClippingPlanes-t.numClipIntersection)}var nA=/^[ \t]*#include +<([\w\d./]+)>/gm;function cd(n){return n.replace(nA,iA)}function iA(n,t){let e=Xt[t];if(e===void 0)throw new Error("THREE.WebGLProgram: Can not resolve #include <"+t+">");return cd(e)}var sA=/#pragma unroll_loop_start\s+for\s*\(\s*int\s+i\s*=\s*(\d+)\s*;\s*i\s*<\s*(\d+)\s*;\s*i\s*\+\+\s*\)\s*{([\s\S]+?)}\s+#pragma unroll_loop_end/g;function n_(n){return n.replace(sA,rA)}function rA(n,t,e,i){let s="";for(let r=parseInt(t);r<parseInt(e);r++)s+=i.replace(/\[\s*i\s*\]/g,"[ "+r+" ]").replace(/UNROLLED_LOOP_INDEX/g,r);return s}function i_(n){let t=`precision ${n.precision} float;
	precision ${n.precision} int;
	precision ${n.precision} sampler2D;
	precision ${n.precision} samplerCube;
	precision ${n.precision} sampler3D;
	precision ${n.precision} sampler2DArray;
	precision ${n.precision} sampler2DShadow;
	precision ${n.precision} samplerCubeShadow;
	precision ${n.precision} sampler2DArrayShadow;
	precision ${n.precision} isampler2D;
	precision ${n.precision} isampler3D;
	precision ${n.precision} isamplerCube;
	precision ${n.precision} isampler2DArray;
	precision ${n.precision} usampler2D;
	precision ${n.precision} usampler3D;
	precision ${n.precision} usamplerCube;
	precision ${n.precision} usampler2DArray;
	`;return n.precision==="highp"?t+=`
#define HIGH_PRECISION`:n.precision==="mediump"?t+=`
#define MEDIUM_PRECISION`:n.precision==="lowp"&&(t+=`
#define LOW_PRECISION`),t}var oA={[Ko]:"SHADOWMAP_TYPE_PCF",[Dr]:"SHADOWMAP_TYPE_VSM"};function aA(n){return oA[n.shadowMapType]||"SHADOWMAP_TYPE_BASIC"}var lA={[Or]:"ENVMAP_MODE_REFRACTION"};function cA(n){return n.envMap===!1?"ENVMAP_MODE_REFLECTION":lA[n.envMapMode]||"ENVMAP_MODE_REFLECTION"}var hA={[mc]:"ENVMAP_BLENDING_MULTIPLY",[y0]:"ENVMAP_BLENDING_MIX",[v0]:"ENVMAP_BLENDING_ADD"};function uA(n){return n.envMap===!1?"ENVMAP_BLENDING_NONE":hA[n.combine]||"ENVMAP_BLENDING_NONE"}function fA(n,t,e,i){let s=n.getContext(),r=e.defines,o=e.vertexShader,a=e.fragmentShader,c=aA(e),l=e.envMapPMREM===!0?"ENVMAP_TYPE_PMREM":"ENVMAP_TYPE_CUBE",h=cA(e),u=uA(e),f=Q1(e),d=tA(r),m=s.createProgram(),_,p,g=e.glslVersion?"#version "+e.glslVersion+`
`:"";e.isRawShaderMaterial?(_=["#define SHADER_TYPE "+e.shaderType,"#define SHADER_NAME "+e.shaderName,d].filter(ca).join(`
`),_.length>0&&(_+=`
`),p=["#define SHADER_TYPE "+e.shaderType,"#define SHADER_NAME "+e.shaderName,d].filter(ca).join(`
`),p.length>0&&(p+=`
`)):(_=[i_(e),"#define SHADER_TYPE "+e.shaderType,"#define SHADER_NAME "+e.shaderName,d,e.extensionClipCullDistance?"#define USE_CLIP_DISTANCE":"",e.batching?"#define USE_BATCHING":"",e.batchingColor?"#define USE_BATCHING_COLOR":"",e.instancing?"#define USE_INSTANCING":"",e.instancingColor?"#define USE_INSTANCING_COLOR":"",e.instancingMorph?"#define USE_INSTANCING_MORPH":"",e.useFog&&e.fog?"#define USE_FOG":"",e.useFog&&e.fogExp2?"#define FOG_EXP2":"",e.map?"#define USE_MAP":"",e.envMap?"#define USE_ENVMAP":"",e.envMap?"#define "+h:"",e.lightMap?"#define USE_LIGHTMAP":"",e.aoMap?"#define USE_AOMAP":"",e.bumpMap?"#define USE_BUMPMAP":"",e.normalMap?"#define USE_NORMALMAP":"",e.normalMapObjectSpace?"#define USE_NORMALMAP_OBJECTSPACE":"",e.normalMapTangentSpace?"#define USE_NORMALMAP_TANGENTSPACE":"",e.displacementMap?"#define USE_DISPLACEMENTMAP":"",e.emissiveMap?"#define USE_EMISSIVEMAP":"",e.anisotropy?"#define USE_ANISOTROPY":"",e.anisotropyMap?"#define USE_ANISOTROPYMAP":"",e.clearcoatMap?"#define USE_CLEARCOATMAP":"",e.clearcoatRoughnessMap?"#define USE_CLEARCOAT_ROUGHNESSMAP":"",e.clearcoatNormalMap?"#define USE_CLEARCOAT_NORMALMAP":"",e.diffuseRoughnessMap?"#define USE_DIFFUSE_ROUGHNESSMAP":"",e.iridescenceMap?"#define USE_IRIDESCENCEMAP":"",e.iridescenceThicknessMap?"#define USE_IRIDESCENCE_THICKNESSMAP":"",e.specularMap?"#define USE_SPECULARMAP":"",e.specularColorMap?"#define USE_SPECULAR_COLORMAP":"",e.specularIntensityMap?"#define USE_SPECULAR_INTENSITYMAP":"",e.roughnessMap?"#define USE_ROUGHNESSMAP":"",e.metalnessMap?"#define USE_METALNESSMAP":"",e.alphaMap?"#define USE_ALPHAMAP":"",e.alphaHash?"#define USE_ALPHAHASH":"",e.transmission?"#define USE_TRANSMISSION":"",e.transmissionMap?"#define USE_TRANSMISSIONMAP":"",e.thicknessMap?"#define USE_THICKNESSMAP":"",e.sheenColorMap?"#define USE_SHEEN_COLORMAP":"",e.sheenRoughnessMap?"#define USE_SHEEN_ROUGHNESSMAP":"",e.mapUv?"#define MAP_UV "+e.mapUv:"",e.alphaMapUv?"#define ALPHAMAP_UV "+e.alphaMapUv:"",e.lightMapUv?"#define LIGHTMAP_UV "+e.lightMapUv:"",e.aoMapUv?"#define AOMAP_UV "+e.aoMapUv:"",e.emissiveMapUv?"#define EMISSIVEMAP_UV "+e.emissiveMapUv:"",e.bumpMapUv?"#define BUMPMAP_UV "+e.bumpMapUv:"",e.normalMapUv?"#define NORMALMAP_UV "+e.normalMapUv:"",e.displacementMapUv?"#define DISPLACEMENTMAP_UV "+e.displacementMapUv:"",e.metalnessMapUv?"#define METALNESSMAP_UV "+e.metalnessMapUv:"",e.roughnessMapUv?"#define ROUGHNESSMAP_UV "+e.roughnessMapUv:"",e.anisotropyMapUv?"#define ANISOTROPYMAP_UV "+e.anisotropyMapUv:"",e.clearcoatMapUv?"#define CLEARCOATMAP_UV "+e.clearcoatMapUv:"",e.clearcoatNormalMapUv?"#define CLEARCOAT_NORMALMAP_UV "+e.clearcoatNormalMapUv:"",e.clearcoatRoughnessMapUv?"#define CLEARCOAT_ROUGHNESSMAP_UV "+e.clearcoatRoughnessMapUv:"",e.diffuseRoughnessMapUv?"#define DIFFUSE_ROUGHNESSMAP_UV "+e.diffuseRoughnessMapUv:"",e.iridescenceMapUv?"#define IRIDESCENCEMAP_UV "+e.iridescenceMapUv:"",e.iridescenceThicknessMapUv?"#define IRIDESCENCE_THICKNESSMAP_UV "+e.iridescenceThicknessMapUv:"",e.sheenColorMapUv?"#define SHEEN_COLORMAP_UV "+e.sheenColorMapUv:"",e.sheenRoughnessMapUv?"#define SHEEN_ROUGHNESSMAP_UV "+e.sheenRoughnessMapUv:"",e.specularMapUv?"#define SPECULARMAP_UV "+e.specularMapUv:"",e.specularColorMapUv?"#define SPECULAR_COLORMAP_UV "+e.specularColorMapUv:"",e.specularIntensityMapUv?"#define SPECULAR_INTENSITYMAP_UV "+e.specularIntensityMapUv:"",e.transmissionMapUv?"#define TRANSMISSIONMAP_UV "+e.transmissionMapUv:"",e.thicknessMapUv?"#define THICKNESSMAP_UV "+e.thicknessMapUv:"",e.vertexTangents&&e.flatShading===!1?"#define USE_TANGENT":"",e.vertexNormals?"#define HAS_NORMAL":"",e.vertexColors?"#define USE_COLOR":"",e.vertexAlphas?"#define USE_COLOR_ALPHA":"",e.vertexUv1s?"#define USE_UV1":"",e.vertexUv2s?"#define USE_UV2":"",e.vertexUv3s?"#define USE_UV3":"",e.pointsUvs?"#define USE_POINTS_UV":"",e.flatShading?"#define FLAT_SHADED":"",e.skinning?"#define USE_SKINNING":"",e.morphTargets?"#define USE_MORPHTARGETS":"",e.morphNormals&&e.flatShading===!1?"#define USE_MORPHNORMALS":"",e.morphColors?"#define USE_MORPHCOLORS":"",e.morphTargetsCount>0?"#define MORPHTARGETS_TEXTURE_STRIDE "+e.morphTextureStride:"",e.morphTargetsCount>0?"#define MORPHTARGETS_COUNT "+e.morphTargetsCount:"",e.doubleSided?"#define DOUBLE_SIDED":"",e.flipSided?"#define FLIP_SIDED":"",e.shadowMapEnabled?"#define USE_SHADOWMAP":"",e.shadowMapEnabled?"#define "+c:"",e.sizeAttenuation?"#define USE_SIZEATTENUATION":"",e.numLightProbes>0?"#define USE_LIGHT_PROBES":"",e.logarithmicDepthBuffer?"#define USE_LOGARITHMIC_DEPTH_BUFFER":"",e.reversedDepthBuffer?"#define USE_REVERSED_DEPTH_BUFFER":"","uniform mat4 modelMatrix;","uniform mat4 modelViewMatrix;","uniform mat4 projectionMatrix;","uniform mat4 viewMatrix;","uniform mat3 normalMatrix;","uniform vec3 cameraPosition;","uniform bool isOrthographic;","#ifdef USE_INSTANCING","	attribute mat4 instanceMatrix;","#endif","#ifdef USE_INSTANCING_COLOR","	attribute vec3 instanceColor;","#endif","#ifdef USE_INSTANCING_MORPH","	uniform sampler2D morphTexture;","#endif","attribute vec3 position;","attribute vec3 normal;","attribute vec2 uv;","#ifdef USE_UV1","	attribute vec2 uv1;","#endif","#ifdef USE_UV2","	attribute vec2 uv2;","#endif","#ifdef USE_UV3","	attribute vec2 uv3;","#endif","#ifdef USE_TANGENT","	attribute vec4 tangent;","#endif","#if defined( USE_COLOR_ALPHA )","	attribute vec4 color;","#elif defined( USE_COLOR )","	attribute vec3 color;","#endif","#ifdef USE_SKINNING","	attribute vec4 skinIndex;","	attribute vec4 skinWeight;","#endif",`
`].filter(ca).join(`
`),p=[i_(e),"#define SHADER_TYPE "+e.shaderType,"#define SHADER_NAME "+e.shaderName,d,e.useFog&&e.fog?"#define USE_FOG":"",e.useFog&&e.fogExp2?"#define FOG_EXP2":"",e.alphaToCoverage?"#define ALPHA_TO_COVERAGE":"",e.map?"#define USE_MAP":"",e.matcap?"#define USE_MATCAP":"",e.envMap?"#define USE_ENVMAP":"",e.envMap?"#define "+l:"",e.envMap?"#define "+h:"",e.envMap?"#define "+u:"",e.envMapPMREM?"#define ENVMAP_MAX_LOD "+e.envMapMaxLod+".0":"",e.envMapPMREM?"#define ENVMAP_SIZE "+e.envMapSize+".0":"",e.lightMap?"#define USE_LIGHTMAP":"",e.aoMap?"#define USE_AOMAP":"",e.bumpMap?"#define USE_BUMPMAP":"",e.normalMap?"#define USE_NORMALMAP":"",e.normalMapObjectSpace?"#define USE_NORMALMAP_OBJECTSPACE":"",e.normalMapTangentSpace?"#define USE_NORMALMAP_TANGENTSPACE":"",e.packedNormalMap?"#define USE_PACKED_NORMALMAP":"",e.emissiveMap?"#define USE_EMISSIVEMAP":"",e.anisotropy?"#define USE_ANISOTROPY":"",e.anisotropyMap?"#define USE_ANISOTROPYMAP":"",e.clearcoat?"#define USE_CLEARCOAT":"",e.clearcoatMap?"#define USE_CLEARCOATMAP":"",e.clearcoatRoughnessMap?"#define USE_CLEARCOAT_ROUGHNESSMAP":"",e.clearcoatNormalMap?"#define USE_CLEARCOAT_NORMALMAP":"",e.diffuseRoughness?"#define USE_DIFFUSE_ROUGHNESS":"",e.diffuseRoughnessMap?"#define USE_DIFFUSE_ROUGHNESSMAP":"",e.dispersion?"#define USE_DISPERSION":"",e.retroreflection?"#define USE_RETROREFLECTION":"",e.iridescence?"#define USE_IRIDESCENCE":"",e.iridescenceMap?"#define USE_IRIDESCENCEMAP":"",e.iridescenceThicknessMap?"#define USE_IRIDESCENCE_THICKNESSMAP":"",e.specularMap?"#define USE_SPECULARMAP":"",e.specularColorMap?"#define USE_SPECULAR_COLORMAP":"",e.specularIntensityMap?"#define USE_SPECULAR_INTENSITYMAP":"",e.roughnessMap?"#define USE_ROUGHNESSMAP":"",e.metalnessMap?"#define USE_METALNESSMAP":"",e.alphaMap?"#define USE_ALPHAMAP":"",e.alphaTest?"#define USE_ALPHATEST":"",e.alphaHash?"#define USE_ALPHAHASH":"",e.sheen?"#define USE_SHEEN":"",e.sheenColorMap?"#define USE_SHEEN_COLORMAP":"",e.sheenRoughnessMap?"#define USE_SHEEN_ROUGHNESSMAP":"",e.transmission?"#define USE_TRANSMISSION":"",e.transmissionMap?"#define USE_TRANSMISSIONMAP":"",e.thicknessMap?"#define USE_THICKNESSMAP":"",e.vertexTangents&&e.flatShading===!1?"#define USE_TANGENT":"",e.vertexColors||e.instancingColor?"#define USE_COLOR":"",e.vertexAlphas||e.batchingColor?"#define USE_COLOR_ALPHA":"",e.vertexUv1s?"#define USE_UV1":"",e.vertexUv2s?"#define USE_UV2":"",e.vertexUv3s?"#define USE_UV3":"",e.pointsUvs?"#define USE_POINTS_UV":"",e.gradientMap?"#define USE_GRADIENTMAP":"",e.flatShading?"#define FLAT_SHADED":"",e.doubleSided?"#define DOUBLE_SIDED":"",e.flipSided?"#define FLIP_SIDED":"",e.shadowMapEnabled?"#define USE_SHADOWMAP":"",e.shadowMapEnabled?"#define "+c:"",e.premultipliedAlpha?"#define PREMULTIPLIED_ALPHA":"",e.numLightProbes>0?"#define USE_LIGHT_PROBES":"",e.decodeVideoTexture?"#define DECODE_VIDEO_TEXTURE":"",e.decodeVideoTextureEmissive?"#define DECODE_VIDEO_TEXTURE_EMISSIVE":"",e.logarithmicDepthBuffer?"#define USE_LOGARITHMIC_DEPTH_BUFFER":"",e.reversedDepthBuffer?"#define USE_REVERSED_DEPTH_BUFFER":"","uniform mat4 viewMatrix;","uniform vec3 cameraPosition;","uniform bool isOrthographic;",e.toneMapping!==Jn?"#define TONE_MAPPING":"",e.toneMapping!==Jn?Xt.tonemapping_pars_fragment:"",e.toneMapping!==Jn?j1("toneMapping",e.toneMapping):"",e.dithering?"#define DITHERING":"",e.opaque?"#define OPAQUE":"",Xt.colorspace_pars_fragment,Z1("linearToOutputTexel",e.outputColorSpace),K1(),e.useDepthPacking?"#define DEPTH_PACKING "+e.depthPacking:"",`
`].filter(ca).join(`
`)),o=cd(o),o=t_(o,e),o=e_(o,e),a=cd(a),a=t_(a,e),a=e_(a,e),o=n_(o),a=n_(a),e.isRawShaderMaterial!==!0&&(g=`#version 300 es
`,_=[f,"#define attribute in","#define varying out","#define texture2D texture"].join(`
`)+`
`+_,p=["#define varying in",e.glslVersion===Yf?"":"layout(location = 0) out highp vec4 pc_fragColor;",e.glslVersion===Yf?"":"#define gl_FragColor pc_fragColor","#define gl_FragDepthEXT gl_FragDepth","#define texture2D texture","#define textureCube texture","#define texture2DProj textureProj","#define texture2DLodEXT textureLod","#define texture2DProjLodEXT textureProjLod","#define textureCubeLodEXT textureLod","#define texture2DGradEXT textureGrad","#define texture2DProjGradEXT textureProjGrad","#define textureCubeGradEXT textureGrad"].join(`
`)+`
`+p);let x=g+_+o,b=g+p+a,v=j0(s,s.VERTEX_SHADER,x),w=j0(s,s.FRAGMENT_SHADER,b);s.attachShader(m,v),s.attachShader(m,w),e.index0AttributeName!==void 0?s.bindAttribLocation(m,0,e.index0AttributeName):e.hasPositionAttribute===!0&&s.bindAttribLocation(m,0,"position"),s.linkProgram(m);function E(R){if(n.debug.checkShaderErrors){let D=s.getProgramInfoLog(m)||"",N=s.getShaderInfoLog(v)||"",B=s.getShaderInfoLog(w)||"",C=D.trim(),z=N.trim(),$=B.trim(),G=!0,st=!0;if(s.getProgramParameter(m,s.LINK_STATUS)===!1)if(G=!1,typeof n.debug.onShaderError=="function")n.debug.onShaderError(s,m,v,w);else{let X=Q0(s,v,"vertex"),Z=Q0(s,w,"fragment");Ot("WebGLProgram: Shader Error "+s.getError()+" - VALIDATE_STATUS "+s.getProgramParameter(m,s.VALIDATE_STATUS)+`

Material Name: `+R.name+`
Material Type: `+R.type+`

Program Info Log: `+C+`
`+X+`
`+Z)}else C!==""?Nt("WebGLProgram: Program Info Log:",C):(z===""||$==="")&&(st=!1);st&&(R.diagnostics={runnable:G,programLog:C,vertexShader:{log:z,prefix:_},fragmentShader:{log:$,prefix:p}})}s.deleteShader(v),s.deleteShader(w),y=new Br(s,m),M=eA(s,m)}let y;this.getUniforms=function(){return y===void 0&&E(this),y};let M;this.getAttributes=function(){return M===void 0&&E(this),M};let L=e.rendererExtensionParallelShaderCompile===!1;return this.isReady=function(){return L===!1&&(L=s.getProgramParameter(m,X1)),L},this.destroy=function(){i.releaseStatesOfProgram(this),s.deleteProgram(m),this.program=void 0},this.type=e.shaderType,this.name=e.shaderName,this.id=$1++,this.cacheKey=t,this.usedTimes=1,this.program=m,this.vertexShader=v,this.fragmentShader=w,this}var dA=0,hd=class{constructor(){this.shaderCache=new Map,this.materialCache=new Map}update(t,e,i){let s=this._getShaderCacheForMaterial(t);return s.has(e)===!1&&(s.add(e),e.usedTimes++),s.has(i)===!1&&(s.add(i),i.usedTimes++),this}remove(t){let e=this.materialCache.get(t);for(let i of e)i.usedTimes--,i.usedTimes===0&&this.shaderCache.delete(i.code);return this.materialCache.delete(t),this}getVertexShaderStage(t){return this._getShaderStage(t.vertexShader)}getFragmentShaderStage(t){return this._getShaderStage(t.fragmentShader)}dispose(){this.shaderCache.clear(),this.materialCache.clear()}_getShaderCacheForMaterial(t){let e=this.materialCache,i=e.get(t);return i===void 0&&(i=new Set,e.set(t,i)),i}_getShaderStage(t){let e=this.shaderCache,i=e.get(t);return i===void 0&&(i=new ud(t),e.set(t,i)),i}},ud=class{constructor(t){this.id=dA++,this.code=t,this.usedTimes=0}};function pA(n){return n===Ji||n===sa||n===ra}function mA(n,t,e,i,s,r){let o=new wr,a=new hd,c=new Set,l=[],h=new Map,u=i.logarithmicDepthBuffer,f={MeshDepthMaterial:"depth",MeshDistanceMaterial:"distance",MeshNormalMaterial:"normal",MeshBasicMaterial:"basic",MeshLambertMaterial:"lambert",MeshPhongMaterial:"phong",MeshToonMaterial:"toon",MeshStandardMaterial:"physical",MeshPhysicalMaterial:"physical",MeshMatcapMaterial:"matcap",LineBasicMaterial:"basic",LineDashedMaterial:"dashed",PointsMaterial:"points",ShadowMaterial:"shadow",SpriteMaterial:"sprite"};function d(y){return c.add(y),y===0?"uv":`uv${y}`}function m(y,M,L,R,D,N){let B=R.fog,C=D.geometry,z=y.isMeshStandardMaterial||y.isMeshLambertMaterial||y.isMeshPhongMaterial?R.environment:null,$=y.isMeshStandardMaterial||y.isMeshLambertMaterial&&!y.envMap||y.isMeshPhongMaterial&&!y.envMap,G=t.get(y.envMap||z,$),st=f[y.type],X=i.precision;y.precision!==null&&(X=i.getMaxPrecision(y.precision),X!==y.precision&&Nt("WebGLProgram.getParameters:",y.precision,"not supported, using",X,"instead."));let Z=C.morphAttributes.position||C.morphAttributes.normal||C.morphAttributes.color,it=Z!==void 0?Z.length:0,Mt=0;C.morphAttributes.position!==void 0&&(Mt=1),C.morphAttributes.normal!==void 0&&(Mt=2),C.morphAttributes.color!==void 0&&(Mt=3);let Dt,j,W,et;if(st){let vt=tn[st];Dt=vt.vertexShader,j=vt.fragmentShader}else{Dt=y.vertexShader,j=y.fragmentShader;let vt=a.getVertexShaderStage(y),ce=a.getFragmentShaderStage(y);a.update(y,vt,ce),W=vt.id,et=ce.id}let ot=n.getRenderTarget(),O=n.state.buffers.depth.getReversed(),K=D.isInstancedMesh===!0,Tt=D.isBatchedMesh===!0,ct=!!y.map,Rt=!!y.matcap,St=!!G,Pt=St&&G.isPMREMTexture===!0,qt=!!y.aoMap,ee=!!y.lightMap,xe=!!y.bumpMap&&y.wireframe===!1,jt=!!y.normalMap,le=!!y.displacementMap,Qt=!!y.emissiveMap,ke=!!y.metalnessMap,mn=!!y.roughnessMap,gn=y.anisotropy>0,F=y.clearcoat>0,_n=y.diffuseRoughness>0,pe=y.dispersion>0,me=y.retroreflectivity>0,yt=y.iridescence>0,Me=y.sheen>0,Ut=y.transmission>0,kt=gn&&!!y.anisotropyMap,T=F&&!!y.clearcoatMap,S=F&&!!y.clearcoatNormalMap,V=F&&!!y.clearcoatRoughnessMap,rt=_n&&!!y.diffuseRoughnessMap,nt=yt&&!!y.iridescenceMap,ut=yt&&!!y.iridescenceThicknessMap,gt=Me&&!!y.sheenColorMap,J=Me&&!!y.sheenRoughnessMap,Q=!!y.specularMap,dt=!!y.specularColorMap,I=!!y.specularIntensityMap,tt=Ut&&!!y.transmissionMap,Y=Ut&&!!y.thicknessMap,pt=!!y.gradientMap,lt=!!y.alphaMap,ft=y.alphaTest>0,It=!!y.alphaHash,Wt=!!y.extensions,at=Jn;y.toneMapped&&(ot===null||ot.isXRRenderTarget===!0)&&(at=n.toneMapping);let Lt=Pt?G.isCompressedCubeTexture?G.image[0].mipmaps:G.mipmaps:null,Ht={shaderID:st,shaderType:y.type,shaderName:y.name,vertexShader:Dt,fragmentShader:j,defines:y.defines,customVertexShaderID:W,customFragmentShaderID:et,isRawShaderMaterial:y.isRawShaderMaterial===!0,glslVersion:y.glslVersion,precision:X,batching:Tt,batchingColor:Tt&&D._colorsTexture!==null,instancing:K,instancingColor:K&&D.instanceColor!==null,instancingMorph:K&&D.morphTexture!==null,outputColorSpace:ot===null?n.outputColorSpace:ot.isXRRenderTarget===!0?ot.texture.colorSpace:Jt.workingColorSpace,alphaToCoverage:!!y.alphaToCoverage,map:ct,matcap:Rt,envMap:St,envMapMode:St&&G.mapping,envMapPMREM:Pt,envMapMaxLod:Pt?Lt.length-1:null,envMapSize:Pt?Lt[0].width:null,aoMap:qt,lightMap:ee,bumpMap:xe,normalMap:jt,displacementMap:le,emissiveMap:Qt,normalMapObjectSpace:jt&&y.normalMapType===S0,normalMapTangentSpace:jt&&y.normalMapType===eh,packedNormalMap:jt&&y.normalMapType===eh&&pA(y.normalMap.format),metalnessMap:ke,roughnessMap:mn,anisotropy:gn,anisotropyMap:kt,clearcoat:F,clearcoatMap:T,clearcoatNormalMap:S,clearcoatRoughnessMap:V,diffuseRoughness:_n,diffuseRoughnessMap:rt,dispersion:pe,retroreflection:me,iridescence:yt,iridescenceMap:nt,iridescenceThicknessMap:ut,sheen:Me,sheenColorMap:gt,sheenRoughnessMap:J,specularMap:Q,specularColorMap:dt,specularIntensityMap:I,transmission:Ut,transmissionMap:tt,thicknessMap:Y,gradientMap:pt,opaque:y.transparent===!1&&y.blending===Ur&&y.alphaToCoverage===!1,alphaMap:lt,alphaTest:ft,alphaHash:It,combine:y.combine,mapUv:ct&&d(y.map.channel),aoMapUv:qt&&d(y.aoMap.channel),lightMapUv:ee&&d(y.lightMap.channel),bumpMapUv:xe&&d(y.bumpMap.channel),normalMapUv:jt&&d(y.normalMap.channel),displacementMapUv:le&&d(y.displacementMap.channel),emissiveMapUv:Qt&&d(y.emissiveMap.channel),metalnessMapUv:ke&&d(y.metalnessMap.channel),roughnessMapUv:mn&&d(y.roughnessMap.channel),anisotropyMapUv:kt&&d(y.anisotropyMap.channel),clearcoatMapUv:T&&d(y.clearcoatMap.channel),clearcoatNormalMapUv:S&&d(y.clearcoatNormalMap.channel),clearcoatRoughnessMapUv:V&&d(y.clearcoatRoughnessMap.channel),diffuseRoughnessMapUv:rt&&d(y.diffuseRoughnessMap.channel),iridescenceMapUv:nt&&d(y.iridescenceMap.channel),iridescenceThicknessMapUv:ut&&d(y.iridescenceThicknessMap.channel),sheenColorMapUv:gt&&d(y.sheenColorMap.channel),sheenRoughnessMapUv:J&&d(y.sheenRoughnessMap.channel),specularMapUv:Q&&d(y.specularMap.channel),specularColorMapUv:dt&&d(y.specularColorMap.channel),specularIntensityMapUv:I&&d(y.specularIntensityMap.channel),transmissionMapUv:tt&&d(y.transmissionMap.channel),thicknessMapUv:Y&&d(y.thicknessMap.channel),alphaMapUv:lt&&d(y.alphaMap.channel),vertexTangents:!!C.attributes.tangent&&(jt||gn),vertexNormals:!!C.attributes.normal,vertexColors:y.vertexColors,vertexAlphas:y.vertexColors===!0&&!!C.attributes.color&&C.attributes.color.itemSize===4,pointsUvs:D.isPoints===!0&&!!C.attributes.uv&&(ct||lt),fog:!!B,useFog:y.fog===!0,fogExp2:!!B&&B.isFogExp2,flatShading:y.wireframe===!1&&(y.flatShading===!0||C.attributes.normal===void 0&&jt===!1&&(y.isMeshLambertMaterial||y.isMeshPhongMaterial||y.isMeshStandardMaterial||y.isMeshPhysicalMaterial)),sizeAttenuation:y.sizeAttenuation===!0,logarithmicDepthBuffer:u,reversedDepthBuffer:O,skinning:D.isSkinnedMesh===!0,hasPositionAttribute:C.attributes.position!==void 0,morphTargets:C.morphAttributes.position!==void 0,morphNormals:C.morphAttributes.normal!==void 0,morphColors:C.morphAttributes.color!==void 0,morphTargetsCount:it,morphTextureStride:Mt,numSunLights:M.sun.length,numDirLights:M.directional.length,numPointLights:M.point.length,numSpotLights:M.spot.length,numSpotLightMaps:M.spotLightMap.length,numRectAreaLights:M.rectArea.length,numHemiLights:M.hemi.length,numSunLightShadows:M.sunShadowMap.length,numDirLightShadows:M.directionalShadowMap.length,numPointLightShadows:M.pointShadowMap.length,numSpotLightShadows:M.spotShadowMap.length,numSpotLightShadowsWithMaps:M.numSpotLightShadowsWithMaps,numLightProbes:M.numLightProbes,numLightProbeGrids:N.filter(vt=>vt.texture!==null).length,numClippingPlanes:r.numPlanes,numClipIntersection:r.numIntersection,dithering:y.dithering,shadowMapEnabled:n.shadowMap.enabled&&L.length>0,shadowMapType:n.shadowMap.type,toneMapping:at,decodeVideoTexture:ct&&y.map.isVideoTexture===!0&&Jt.getTransfer(y.map.colorSpace)===se,decodeVideoTextureEmissive:Qt&&y.emissiveMap.isVideoTexture===!0&&Jt.getTransfer(y.emissiveMap.colorSpace)===se,premultipliedAlpha:y.premultipliedAlpha,doubleSided:y.side===Tn,flipSided:y.side===Ue,useDepthPacking:y.depthPacking>=0,depthPacking:y.depthPacking||0,index0AttributeName:y.index0AttributeName,extensionClipCullDistance:Wt&&y.extensions.clipCullDistance===!0&&e.has("WEBGL_clip_cull_distance"),extensionMultiDraw:(Wt&&y.extensions.multiDraw===!0||Tt)&&e.has("WEBGL_multi_draw"),rendererExtensionParallelShaderCompile:e.has("KHR_parallel_shader_compile"),customProgramCacheKey:y.customProgramCacheKey()};return Ht.vertexUv1s=c.has(1),Ht.vertexUv2s=c.has(2),Ht.vertexUv3s=c.has(3),c.clear(),Ht}function _(y){let M=[];if(y.shaderID?M.push(y.shaderID):(M.push(y.customVertexShaderID),M.push(y.customFragmentShaderID)),y.defines!==void 0)for(let L in y.defines)M.push(L),M.push(y.defines[L]);return y.isRawShaderMaterial===!1&&(p(M,y),g(M,y),M.push(n.outputColorSpace)),M.push(y.customProgramCacheKey),M.join()}function p(y,M){y.push(M.precision),y.push(M.outputColorSpace),y.push(M.envMapMode),y.push(M.envMapPMREM),y.push(M.envMapMaxLod),y.push(M.envMapSize),y.push(M.mapUv),y.push(M.alphaMapUv),y.push(M.lightMapUv),y.push(M.aoMapUv),y.push(M.bumpMapUv),y.push(M.normalMapUv),y.push(M.displacementMapUv),y.push(M.emissiveMapUv),y.push(M.metalnessMapUv),y.push(M.roughnessMapUv),y.push(M.anisotropyMapUv),y.push(M.clearcoatMapUv),y.push(M.clearcoatNormalMapUv),y.push(M.clearcoatRoughnessMapUv),y.push(M.diffuseRoughnessMapUv),y.push(M.iridescenceMapUv),y.push(M.iridescenceThicknessMapUv),y.push(M.sheenColorMapUv),y.push(M.sheenRoughnessMapUv),y.push(M.specularMapUv),y.push(M.specularColorMapUv),y.push(M.specularIntensityMapUv),y.push(M.transmissionMapUv),y.push(M.thicknessMapUv),y.push(M.combine),y.push(M.fogExp2),y.push(M.sizeAttenuation),y.push(M.morphTargetsCount),y.push(M.numSunLights),y.push(M.numDirLights),y.push(M.numPointLights),y.push(M.numSpotLights),y.push(M.numSpotLightMaps),y.push(M.numHemiLights),y.push(M.numRectAreaLights),y.push(M.numSunLightShadows),y.push(M.numDirLightShadows),y.push(M.numPointLightShadows),y.push(M.numSpotLightShadows),y.push(M.numSpotLightShadowsWithMaps),y.push(M.numLightProbes),y.push(M.numLightProbeGrids),y.push(M.shadowMapType),y.push(M.toneMapping),y.push(M.numClippingPlanes),y.push(M.numClipIntersection),y.push(M.depthPacking)}function g(y,M){o.disableAll(),M.instancing&&o.enable(0),M.instancingColor&&o.enable(1),M.instancingMorph&&o.enable(2),M.matcap&&o.enable(3),M.envMap&&o.enable(4),M.normalMapObjectSpace&&o.enable(5),M.normalMapTangentSpace&&o.enable(6),M.clearcoat&&o.enable(7),M.iridescence&&o.enable(8),M.alphaTest&&o.enable(9),M.vertexColors&&o.enable(10),M.vertexAlphas&&o.enable(11),M.vertexUv1s&&o.enable(12),M.vertexUv2s&&o.enable(13),M.vertexUv3s&&o.enable(14),M.vertexTangents&&o.enable(15),M.anisotropy&&o.enable(16),M.alphaHash&&o.enable(17),M.batching&&o.enable(18),M.dispersion&&o.enable(19),M.retroreflection&&o.enable(24),M.diffuseRoughness&&o.enable(25),M.batchingColor&&o.enable(20),M.gradientMap&&o.enable(21),M.packedNormalMap&&o.enable(22),M.vertexNormals&&o.enable(23),y.push(o.mask),o.disableAll(),M.fog&&o.enable(0),M.useFog&&o.enable(1),M.flatShading&&o.enable(2),M.logarithmicDepthBuffer&&o.enable(3),M.reversedDepthBuffer&&o.enable(4),M.skinning&&o.enable(5),M.morphTargets&&o.enable(6),M.morphNormals&&o.enable(7),M.morphColors&&o.enable(8),M.premultipliedAlpha&&o.enable(9),M.shadowMapEnabled&&o.enable(10),M.doubleSided&&o.enable(11),M.flipSided&&o.enable(12),M.useDepthPacking&&o.enable(13),M.dithering&&o.enable(14),M.transmission&&o.enable(15),M.sheen&&o.enable(16),M.opaque&&o.enable(17),M.pointsUvs&&o.enable(18),M.decodeVideoTexture&&o.enable(19),M.decodeVideoTextureEmissive&&o.enable(20),M.alphaToCoverage&&o.enable(21),M.numLightProbeGrids>0&&o.enable(22),M.hasPositionAttribute&&o.enable(23),y.push(o.mask)}function x(y){let M=f[y.type],L;if(M){let R=tn[M];L=aa.clone(R.uniforms)}else L=y.uniforms;return L}function b(y,M){let L=h.get(M);return L!==void 0?++L.usedTimes:(L=new fA(n,M,y,s),l.push(L),h.set(M,L)),L}function v(y){if(--y.usedTimes===0){let M=l.indexOf(y);l[M]=l[l.length-1],l.pop(),h.delete(y.cacheKey),y.destroy()}}function w(y){a.remove(y)}function E(){a.dispose()}return{getParameters:m,getProgramCacheKey:_,getUniforms:x,acquireProgram:b,releaseProgram:v,releaseShaderCache:w,programs:l,dispose:E}}function gA(){let n=new WeakMap;function t(o){return n.has(o)}function e(o){let a=n.get(o);return a===void 0&&(a={},n.set(o,a)),a}function i(o){n.delete(o)}function s(o,a,c){n.get(o)[a]=c}function r(){n=new WeakMap}return{has:t,get:e,remove:i,update:s,dispose:r}}function _A(n,t){return n.groupOrder!==t.groupOrder?n.groupOrder-t.groupOrder:n.renderOrder!==t.renderOrder?n.renderOrder-t.renderOrder:n.material.id!==t.material.id?n.material.id-t.material.id:n.materialVariant!==t.materialVariant?n.materialVariant-t.materialVariant:n.z!==t.z?n.z-t.z:n.id-t.id}function s_(n,t){return n.groupOrder!==t.groupOrder?n.groupOrder-t.groupOrder:n.renderOrder!==t.renderOrder?n.renderOrder-t.renderOrder:n.z!==t.z?t.z-n.z:n.id-t.id}function r_(){let n=[],t=0,e=[],i=[],s=[];function r(){t=0,e.length=0,i.length=0,s.length=0}function o(f){let d=0;return f.isInstancedMesh&&(d+=2),f.isSkinnedMesh&&(d+=1),d}function a(f,d,m,_,p,g){let x=n[t];return x===void 0?(x={id:f.id,object:f,geometry:d,material:m,materialVariant:o(f),groupOrder:_,renderOrder:f.renderOrder,z:p,group:g},n[t]=x):(x.id=f.id,x.object=f,x.geometry=d,x.material=m,x.materialVariant=o(f),x.groupOrder=_,x.renderOrder=f.renderOrder,x.z=p,x.group=g),t++,x}function c(f,d,m,_,p,g,x){x.reversedDepth===!0&&(p=-p);let b=a(f,d,m,_,p,g);m.transmission>0?i.push(b):m.transparent===!0?s.push(b):e.push(b)}function l(f,d,m,_,p,g){let x=a(f,d,m,_,p,g);m.transmission>0?i.unshift(x):m.transparent===!0?s.unshift(x):e.unshift(x)}function h(f,d){e.length>1&&e.sort(f||_A),i.length>1&&i.sort(d||s_),s.length>1&&s.sort(d||s_)}function u(){for(let f=t,d=n.length;f<d;f++){let m=n[f];if(m.id===null)break;m.id=null,m.object=null,m.geometry=null,m.material=null,m.group=null}}return{opaque:e,transmissive:i,transparent:s,init:r,push:c,unshift:l,finish:u,sort:h}}function xA(){let n=new WeakMap;function t(i,s){let r=n.get(i),o;return r===void 0?(o=new r_,n.set(i,[o])):s>=r.length?(o=new r_,r.push(o)):o=r[s],o}function e(){n=new WeakMap}return{get:t,dispose:e}}function yA(){let n={};return{get:function(t){if(n[t.id]!==void 0)return n[t.id];let e;switch(t.type){case"SunLight":case"DirectionalLight":e={direction:new P,color:new Gt};break;case"SpotLight":e={position:new P,direction:new P,color:new Gt,distance:0,coneCos:0,penumbraCos:0,decay:0};break;case"PointLight":e={position:new P,color:new Gt,distance:0,decay:0};break;case"HemisphereLight":e={direction:new P,skyColor:new Gt,groundColor:new Gt};break;case"RectAreaLight":e={color:new Gt,position:new P,halfWidth:new P,halfHeight:new P};break}return n[t.id]=e,e}}}function vA(){let n={};return{get:function(t){if(n[t.id]!==void 0)return n[t.id];let e;switch(t.type){case"SunLight":case"DirectionalLight":e={shadowIntensity:1,shadowBias:0,shadowNormalBias:0,shadowRadius:1,shadowMapSize:new ht};break;case"SpotLight":e={shadowIntensity:1,shadowBias:0,shadowNormalBias:0,shadowRadius:1,shadowMapSize:new ht};break;case"PointLight":e={shadowIntensity:1,shadowBias:0,shadowNormalBias:0,shadowRadius:1,shadowMapSize:new ht,shadowCameraNear:1,shadowCameraFar:1e3};break}return n[t.id]=e,e}}}var bA=0;function MA(n,t){return(t.castShadow?2:0)-(n.castShadow?2:0)+(t.map?1:0)-(n.map?1:0)}function SA(n){let t=new yA,e=vA(),i={version:0,hash:{sunLength:-1,directionalLength:-1,pointLength:-1,spotLength:-1,rectAreaLength:-1,hemiLength:-1,numSunShadows:-1,numDirectionalShadows:-1,numPointShadows:-1,numSpotShadows:-1,numSpotMaps:-1,numLightProbes:-1},ambient:[0,0,0],probe:[],sun:[],sunShadow:[],sunShadowMap:[],sunShadowMatrix:[],sunShadowCascade:[],directional:[],directionalShadow:[],directionalShadowMap:[],directionalShadowMatrix:[],spot:[],spotLightMap:[],spotShadow:[],spotShadowMap:[],spotLightMatrix:[],rectArea:[],rectAreaLTC1:null,rectAreaLTC2:null,point:[],pointShadow:[],pointShadowMap:[],pointShadowMatrix:[],hemi:[],numSpotLightShadowsWithMaps:0,numLightProbes:0};for(let l=0;l<9;l++)i.probe.push(new P);let s=new P,r=new re,o=new re;function a(l){let h=0,u=0,f=0;for(let N=0;N<9;N++)i.probe[N].set(0,0,0);let d=0,m=0,_=0,p=0,g=0,x=0,b=0,v=0,w=0,E=0,y=0,M=0,L=0,R=0;l.sort(MA);for(let N=0,B=l.length;N<B;N++){let C=l[N],z=C.color,$=C.intensity,G=C.distance,st=null;if(C.shadow&&C.shadow.map&&(C.shadow.map.texture.format===Ji?st=C.shadow.map.texture:st=C.shadow.map.depthTexture||C.shadow.map.texture),C.isAmbientLight)h+=z.r*$,u+=z.g*$,f+=z.b*$;else if(C.isLightProbe){for(let X=0;X<9;X++)i.probe[X].addScaledVector(C.sh.coefficients[X],$);R++}else if(C.isSunLight){let X=t.get(C);if(X.color.copy(C.color).multiplyScalar(C.intensity),C.castShadow){let Z=C.shadow,it=e.get(C);it.shadowIntensity=Z.intensity,it.shadowBias=Z.bias,it.shadowNormalBias=Z.normalBias,it.shadowRadius=Z.radius,it.shadowMapSize.copy(Z.mapSize).multiply(Z.getFrameExtents()),i.sunShadow[m]=it,i.sunShadowMap[m]=st;let Mt=Z.getViewportCount();for(let Dt=0;Dt<Mt;Dt++)i.sunShadowMatrix[_+Dt]=Z.getMatrix(Dt),i.sunShadowCascade[_+Dt]=Z._cascadeData[Dt];_+=Mt,m++}i.sun[d]=X,d++}else if(C.isDirectionalLight){let X=t.get(C);if(X.color.copy(C.color).multiplyScalar(C.intensity),C.castShadow){let Z=C.shadow,it=e.get(C);it.shadowIntensity=Z.intensity,it.shadowBias=Z.bias,it.shadowNormalBias=Z.normalBias,it.shadowRadius=Z.radius,it.shadowMapSize=Z.mapSize,i.directionalShadow[p]=it,i.directionalShadowMap[p]=st,i.directionalShadowMatrix[p]=C.shadow.matrix,w++}i.directional[p]=X,p++}else if(C.isSpotLight){let X=t.get(C);X.position.setFromMatrixPosition(C.matrixWorld),X.color.copy(z).multiplyScalar($),X.distance=G,X.coneCos=Math.cos(C.angle),X.penumbraCos=Math.cos(C.angle*(1-C.penumbra)),X.decay=C.decay,i.spot[x]=X;let Z=C.shadow;if(C.map&&(i.spotLightMap[M]=C.map,M++,Z.updateMatrices(C),C.castShadow&&L++),i.spotLightMatrix[x]=Z.matrix,C.castShadow){let it=e.get(C);it.shadowIntensity=Z.intensity,it.shadowBias=Z.bias,it.shadowNormalBias=Z.normalBias,it.shadowRadius=Z.radius,it.shadowMapSize=Z.mapSize,i.spotShadow[x]=it,i.spotShadowMap[x]=st,y++}x++}else if(C.isRectAreaLight){let X=t.get(C);X.color.copy(z).multiplyScalar($),X.halfWidth.set(C.width*.5,0,0),X.halfHeight.set(0,C.height*.5,0),i.rectArea[b]=X,b++}else if(C.isPointLight){let X=t.get(C);if(X.color.copy(C.color).multiplyScalar(C.intensity),X.distance=C.distance,X.decay=C.decay,C.castShadow){let Z=C.shadow,it=e.get(C);it.shadowIntensity=Z.intensity,it.shadowBias=Z.bias,it.shadowNormalBias=Z.normalBias,it.shadowRadius=Z.radius,it.shadowMapSize=Z.mapSize,it.shadowCameraNear=Z.camera.near,it.shadowCameraFar=Z.camera.far,i.pointShadow[g]=it,i.pointShadowMap[g]=st,i.pointShadowMatrix[g]=C.shadow.matrix,E++}i.point[g]=X,g++}else if(C.isHemisphereLight){let X=t.get(C);X.skyColor.copy(C.color).multiplyScalar($),X.groundColor.copy(C.groundColor).multiplyScalar($),i.hemi[v]=X,v++}}b>0&&(n.has("OES_texture_float_linear")===!0?(i.rectAreaLTC1=xt.LTC_FLOAT_1,i.rectAreaLTC2=xt.LTC_FLOAT_2):(i.rectAreaLTC1=xt.LTC_HALF_1,i.rectAreaLTC2=xt.LTC_HALF_2)),i.ambient[0]=h,i.ambient[1]=u,i.ambient[2]=f;let D=i.hash;(D.sunLength!==d||D.directionalLength!==p||D.pointLength!==g||D.spotLength!==x||D.rectAreaLength!==b||D.hemiLength!==v||D.numSunShadows!==m||D.numDirectionalShadows!==w||D.numPointShadows!==E||D.numSpotShadows!==y||D.numSpotMaps!==M||D.numLightProbes!==R)&&(i.sun.length=d,i.directional.length=p,i.spot.length=x,i.rectArea.length=b,i.point.length=g,i.hemi.length=v,i.sunShadow.length=m,i.sunShadowMap.length=m,i.sunShadowMatrix.length=_,i.sunShadowCascade.length=_,i.directionalShadow.length=w,i.directionalShadowMap.length=w,i.directionalShadowMatrix.length=w,i.pointShadow.length=E,i.pointShadowMap.length=E,i.pointShadowMatrix.length=E,i.spotShadow.length=y,i.spotShadowMap.length=y,i.spotLightMatrix.length=y+M-L,i.spotLightMap.length=M,i.numSpotLightShadowsWithMaps=L,i.numLightProbes=R,D.sunLength=d,D.directionalLength=p,D.pointLength=g,D.spotLength=x,D.rectAreaLength=b,D.hemiLength=v,D.numSunShadows=m,D.numDirectionalShadows=w,D.numPointShadows=E,D.numSpotShadows=y,D.numSpotMaps=M,D.numLightProbes=R,i.version=bA++)}function c(l,h){let u=0,f=0,d=0,m=0,_=0,p=0,g=h.matrixWorldInverse;for(let x=0,b=l.length;x<b;x++){let v=l[x];if(v.isSunLight){let w=i.sun[u];w.direction.setFromMatrixPosition(v.matrixWorld),w.direction.transformDirection(g),u++}else if(v.isDirectionalLight){let w=i.directional[f];w.direction.setFromMatrixPosition(v.matrixWorld),s.setFromMatrixPosition(v.target.matrixWorld),w.direction.sub(s),w.direction.transformDirection(g),f++}else if(v.isSpotLight){let w=i.spot[m];w.position.setFromMatrixPosition(v.matrixWorld),w.position.applyMatrix4(g),w.direction.setFromMatrixPosition(v.matrixWorld),s.setFromMatrixPosition(v.target.matrixWorld),w.direction.sub(s),w.direction.transformDirection(g),m++}else if(v.isRectAreaLight){let w=i.rectArea[_];w.position.setFromMatrixPosition(v.matrixWorld),w.position.applyMatrix4(g),o.identity(),r.copy(v.matrixWorld),r.premultiply(g),o.extractRotation(r),w.halfWidth.set(v.width*.5,0,0),w.halfHeight.set(0,v.height*.5,0),w.halfWidth.applyMatrix4(o),w.halfHeight.applyMatrix4(o),_++}else if(v.isPointLight){let w=i.point[d];w.position.setFromMatrixPosition(v.matrixWorld),w.position.applyMatrix4(g),d++}else if(v.isHemisphereLight){let w=i.hemi[p];w.direction.setFromMatrixPosition(v.matrixWorld),w.direction.transformDirection(g),p++}}}return{setup:a,setupView:c,state:i}}function o_(n){let t=new SA(n),e=[],i=[],s=[];function r(u){h.camera=u,e.length=0,i.length=0,s.length=0}function o(u){u.isLightProbeGrid?s.push(u):e.push(u)}function a(u){i.push(u)}function c(){t.setup(e),s.sort((u,f)=>u.priority-f.priority||u.id-f.id)}function l(u){t.setupView(e,u)}let h={lightsArray:e,shadowsArray:i,lightProbeGridArray:s,camera:null,lights:t,transmissionRenderTarget:{},textureUnits:0};return{init:r,state:h,setupLights:c,setupLightsView:l,pushLight:o,pushShadow:a}}function wA(n){let t=new WeakMap;function e(s,r=0){let o=t.get(s),a;return o===void 0?(a=new o_(n),t.set(s,[a])):r>=o.length?(a=new o_(n),o.push(a)):a=o[r],a}function i(){t=new WeakMap}return{get:e,dispose:i}}var AA=`void main() {
	gl_Position = vec4( position, 1.0 );
}`,EA=`uniform sampler2D shadow_pass;
uniform vec2 resolution;
uniform float radius;
void main() {
	const float samples = float( VSM_SAMPLES );
	float mean = 0.0;
	float squared_mean = 0.0;
	float uvStride = samples <= 1.0 ? 0.0 : 2.0 / ( samples - 1.0 );
	float uvStart = samples <= 1.0 ? 0.0 : - 1.0;
	for ( float i = 0.0; i < samples; i ++ ) {
		float uvOffset = uvStart + i * uvStride;
		#ifdef HORIZONTAL_PASS
			vec2 distribution = texture2D( shadow_pass, ( gl_FragCoord.xy + vec2( uvOffset, 0.0 ) * radius ) / resolution ).rg;
			mean += distribution.x;
			squared_mean += distribution.y * distribution.y + distribution.x * distribution.x;
		#else
			float depth = texture2D( shadow_pass, ( gl_FragCoord.xy + vec2( 0.0, uvOffset ) * radius ) / resolution ).r;
			mean += depth;
			squared_mean += depth * depth;
		#endif
	}
	mean = mean / samples;
	squared_mean = squared_mean / samples;
	float std_dev = sqrt( max( 0.0, squared_mean - mean * mean ) );
	gl_FragColor = vec4( mean, std_dev, 0.0, 1.0 );
}`,TA=[new P(1,0,0),new P(-1,0,0),new P(0,1,0),new P(0,-1,0),new P(0,0,1),new P(0,0,-1)],CA=[new P(0,-1,0),new P(0,-1,0),new P(0,0,1),new P(0,0,-1),new P(0,-1,0),new P(0,-1,0)],a_=new re,la=new P,rd=new P;function RA(n,t,e){let i=new Vi,s=new ht,r=new ht,o=new oe,a=new ec,c=new nc,l={},h=e.maxTextureSize,u={[Zi]:Ue,[Ue]:Zi,[Tn]:Tn},f=new En({defines:{VSM_SAMPLES:8},uniforms:{shadow_pass:{value:null},resolution:{value:new ht},radius:{value:4}},vertexShader:AA,fragmentShader:EA}),d=f.clone();d.defines.HORIZONTAL_PASS=1;let m=new ae;m.setAttribute("position",new On(new Float32Array([-1,-1,.5,3,-1,.5,-1,3,.5]),3));let _=new de(m,f),p=this;this.enabled=!1,this.autoUpdate=!0,this.needsUpdate=!1,this.type=Ko;let g=this.type;this.render=function(E,y,M){if(p.enabled===!1||p.autoUpdate===!1&&p.needsUpdate===!1||E.length===0)return;this.type===t0&&(Nt("WebGLShadowMap: PCFSoftShadowMap has been removed. Using PCFShadowMap instead."),this.type=Ko);let L=n.getRenderTarget(),R=n.getActiveCubeFace(),D=n.getActiveMipmapLevel(),N=n.state;N.setBlending(Ps),N.buffers.depth.getReversed()===!0?N.buffers.color.setClear(0,0,0,0):N.buffers.color.setClear(1,1,1,1),N.buffers.depth.setTest(!0),N.setScissorTest(!1);let B=g!==this.type;B&&y.traverse(function(C){C.material&&(Array.isArray(C.material)?C.material.forEach(z=>z.needsUpdate=!0):C.material.needsUpdate=!0)});for(let C=0,z=E.length;C<z;C++){let $=E[C],G=$.shadow;if(G===void 0){Nt("WebGLShadowMap:",$,"has no shadow.");continue}if(G.autoUpdate===!1&&G.needsUpdate===!1)continue;s.copy(G.mapSize);let st=G.getFrameExtents();s.multiply(st),r.copy(G.mapSize),(s.x>h||s.y>h)&&(s.x>h&&(r.x=Math.floor(h/st.x),s.x=r.x*st.x,G.mapSize.x=r.x),s.y>h&&(r.y=Math.floor(h/st.y),s.y=r.y*st.y,G.mapSize.y=r.y));let X=n.state.buffers.depth.getReversed();if(G.camera._reversedDepth=X,G.map===null||B===!0){if(G.map!==null&&(G.map.depthTexture!==null&&(G.map.depthTexture.dispose(),G.map.depthTexture=null),G.map.dispose()),this.type===Dr){if($.isPointLight){Nt("WebGLShadowMap: VSM shadow maps are not supported for PointLights. Use PCF or BasicShadowMap instead.");continue}G.map=new hn(s.x,s.y,{format:Ji,type:Vn,minFilter:Ke,magFilter:Ke,generateMipmaps:!1}),G.map.texture.name=$.name+".shadowMap",G.map.depthTexture=new xi(s.x,s.y,zn),G.map.depthTexture.name=$.name+".shadowMapDepth",G.map.depthTexture.format=pi,G.map.depthTexture.compareFunction=null,G.map.depthTexture.minFilter=Pe,G.map.depthTexture.magFilter=Pe}else $.isPointLight?(G.map=new ha(s.x),G.map.depthTexture=new Ro(s.x,kn)):(G.map=new hn(s.x,s.y),G.map.depthTexture=new xi(s.x,s.y,kn)),G.map.depthTexture.name=$.name+".shadowMap",G.map.depthTexture.format=pi,this.type===Ko?(G.map.depthTexture.compareFunction=X?Xf:Wf,G.map.depthTexture.minFilter=Ke,G.map.depthTexture.magFilter=Ke):(G.map.depthTexture.compareFunction=null,G.map.depthTexture.minFilter=Pe,G.map.depthTexture.magFilter=Pe);G.camera.updateProjectionMatrix()}G.map.isWebGLCubeRenderTarget!==!0&&(G.map.width!==s.x||G.map.height!==s.y)&&G.map.setSize(s.x,s.y);let Z=G.map.isWebGLCubeRenderTarget?6:G.getViewportCount();$.isPointLight!==!0&&G.updateMatrices($,M);let it=(G.camera.layers.mask&4294967294)!==0?G.camera.layers:M.layers;for(let Mt=0;Mt<Z;Mt++){let Dt=G.getCamera(Mt);if($.isPointLight){let j=G.camera,W=G.matrix,et=$.distance||j.far;et!==j.far&&(j.far=et,j.updateProjectionMatrix()),la.setFromMatrixPosition($.matrixWorld),j.position.copy(la),rd.copy(j.position),rd.add(TA[Mt]),j.up.copy(CA[Mt]),j.lookAt(rd),j.updateMatrixWorld(),W.makeTranslation(-la.x,-la.y,-la.z),a_.multiplyMatrices(j.projectionMatrix,j.matrixWorldInverse),G._frustum.setFromProjectionMatrix(a_,j.coordinateSystem,j.reversedDepth)}if(G.map.isWebGLCubeRenderTarget)n.setRenderTarget(G.map,Mt),n.clear();else{Mt===0&&(n.setRenderTarget(G.map),n.clear());let j=G.getViewport(Mt);o.set(r.x*j.x,r.y*j.y,r.x*j.z,r.y*j.w),N.viewport(o)}i=G.getFrustum(Mt),v(y,M,Dt,$,it,this.type)}G.isPointLightShadow!==!0&&this.type===Dr&&x(G,M),G.needsUpdate=!1}g=this.type,p.needsUpdate=!1,n.setRenderTarget(L,R,D)};function x(E,y){let M=t.update(_);f.defines.VSM_SAMPLES!==E.blurSamples&&(f.defines.VSM_SAMPLES=E.blurSamples,d.defines.VSM_SAMPLES=E.blurSamples,f.needsUpdate=!0,d.needsUpdate=!0),E.mapPass===null?E.mapPass=new hn(s.x,s.y,{format:Ji,type:Vn}):(E.mapPass.width!==E.map.width||E.mapPass.height!==E.map.height)&&E.mapPass.setSize(E.map.width,E.map.height),f.uniforms.shadow_pass.value=E.map.depthTexture,f.uniforms.resolution.value.set(E.map.width,E.map.height),f.uniforms.radius.value=E.radius,n.setRenderTarget(E.mapPass),n.clear(),n.renderBufferDirect(y,null,M,f,_,null),d.uniforms.shadow_pass.value=E.mapPass.texture,d.uniforms.resolution.value.set(E.map.width,E.map.height),d.uniforms.radius.value=E.radius,n.setRenderTarget(E.map),n.clear(),n.renderBufferDirect(y,null,M,d,_,null)}function b(E,y,M,L){let R=null,D=M.isPointLight===!0?E.customDistanceMaterial:E.customDepthMaterial;if(D!==void 0)R=D;else if(R=M.isPointLight===!0?c:a,n.localClippingEnabled&&y.clipShadows===!0&&Array.isArray(y.clippingPlanes)&&y.clippingPlanes.length!==0||y.displacementMap&&y.displacementScale!==0||y.alphaMap&&y.alphaTest>0||y.map&&y.alphaTest>0||y.alphaToCoverage===!0){let N=R.uuid,B=y.uuid,C=l[N];C===void 0&&(C={},l[N]=C);let z=C[B];z===void 0&&(z=R.clone(),C[B]=z,y.addEventListener("dispose",w)),R=z}if(R.visible=y.visible,R.wireframe=y.wireframe,L===Dr?R.side=y.shadowSide!==null?y.shadowSide:y.side:R.side=y.shadowSide!==null?y.shadowSide:u[y.side],R.alphaMap=y.alphaMap,R.alphaTest=y.alphaToCoverage===!0?.5:y.alphaTest,R.map=y.map,R.clipShadows=y.clipShadows,R.clippingPlanes=y.clippingPlanes,R.clipIntersection=y.clipIntersection,R.displacementMap=y.displacementMap,R.displacementScale=y.displacementScale,R.displacementBias=y.displacementBias,R.wireframeLinewidth=y.wireframeLinewidth,R.linewidth=y.linewidth,M.isPointLight===!0&&R.isMeshDistanceMaterial===!0){let N=n.properties.get(R);N.light=M}return R}function v(E,y,M,L,R,D){if(E.visible===!1)return;if(E.layers.test(R)&&(E.isMesh||E.isLine||E.isPoints)&&(E.castShadow||E.receiveShadow&&D===Dr)&&(!E.frustumCulled||E.intersectsFrustum(i))){E.modelViewMatrix.multiplyMatrices(M.matrixWorldInverse,E.matrixWorld);let C=t.update(E),z=E.material;if(Array.isArray(z)){let $=C.groups;for(let G=0,st=$.length;G<st;G++){let X=$[G],Z=z[X.materialIndex];if(Z&&Z.visible){let it=b(E,Z,L,D);E.onBeforeShadow(n,E,y,M,C,it,X),n.renderBufferDirect(M,null,C,it,E,X),E.onAfterShadow(n,E,y,M,C,it,X)}}}else if(z.visible){let $=b(E,z,L,D);E.onBeforeShadow(n,E,y,M,C,$,null),n.renderBufferDirect(M,null,C,$,E,null),E.onAfterShadow(n,E,y,M,C,$,null)}}let B=E.children;for(let C=0,z=B.length;C<z;C++)v(B[C],y,M,L,R,D)}function w(E){E.target.removeEventListener("dispose",w);for(let M in l){let L=l[M],R=E.target.uuid;R in L&&(L[R].dispose(),delete L[R])}}}function PA(n,t){function e(){let I=!1,tt=new oe,Y=null,pt=new oe(0,0,0,0);return{setMask:function(lt){Y!==lt&&!I&&(n.colorMask(lt,lt,lt,lt),Y=lt)},setLocked:function(lt){I=lt},setClear:function(lt,ft,It,Wt,at){at===!0&&(lt*=Wt,ft*=Wt,It*=Wt),tt.set(lt,ft,It,Wt),pt.equals(tt)===!1&&(n.clearColor(lt,ft,It,Wt),pt.copy(tt))},reset:function(){I=!1,Y=null,pt.set(-1,0,0,0)}}}function i(){let I=!1,tt=!1,Y=null,pt=null,lt=null;return{setReversed:function(ft){if(tt!==ft){let It=t.get("EXT_clip_control");ft?It.clipControlEXT(It.LOWER_LEFT_EXT,It.ZERO_TO_ONE_EXT):It.clipControlEXT(It.LOWER_LEFT_EXT,It.NEGATIVE_ONE_TO_ONE_EXT),tt=ft;let Wt=lt;lt=null,this.setClear(Wt)}},getReversed:function(){return tt},setTest:function(ft){ft?O(n.DEPTH_TEST):K(n.DEPTH_TEST)},setMask:function(ft){Y!==ft&&!I&&(n.depthMask(ft),Y=ft)},setFunc:function(ft){if(tt&&(ft=N0[ft]),pt!==ft){switch(ft){case Rl:n.depthFunc(n.NEVER);break;case Pl:n.depthFunc(n.ALWAYS);break;case Il:n.depthFunc(n.LESS);break;case yr:n.depthFunc(n.LEQUAL);break;case Ll:n.depthFunc(n.EQUAL);break;case Nl:n.depthFunc(n.GEQUAL);break;case Dl:n.depthFunc(n.GREATER);break;case Ul:n.depthFunc(n.NOTEQUAL);break;default:n.depthFunc(n.LEQUAL)}pt=ft}},setLocked:function(ft){I=ft},setClear:function(ft){lt!==ft&&(lt=ft,tt&&(ft=1-ft),n.clearDepth(ft))},reset:function(){I=!1,Y=null,pt=null,lt=null,tt=!1}}}function s(){let I=!1,tt=null,Y=null,pt=null,lt=null,ft=null,It=null,Wt=null,at=null;return{setTest:function(Lt){I||(Lt?O(n.STENCIL_TEST):K(n.STENCIL_TEST))},setMask:function(Lt){tt!==Lt&&!I&&(n.stencilMask(Lt),tt=Lt)},setFunc:function(Lt,Ht,vt){(Y!==Lt||pt!==Ht||lt!==vt)&&(n.stencilFunc(Lt,Ht,vt),Y=Lt,pt=Ht,lt=vt)},setOp:function(Lt,Ht,vt){(ft!==Lt||It!==Ht||Wt!==vt)&&(n.stencilOp(Lt,Ht,vt),ft=Lt,It=Ht,Wt=vt)},setLocked:function(Lt){I=Lt},setClear:function(Lt){at!==Lt&&(n.clearStencil(Lt),at=Lt)},reset:function(){I=!1,tt=null,Y=null,pt=null,lt=null,ft=null,It=null,Wt=null,at=null}}}let r=new e,o=new i,a=new s,c={},l=new WeakMap,h={},u={},f={},d=new WeakMap,m=[],_=null,p=!1,g=null,x=null,b=null,v=null,w=null,E=null,y=null,M=new Gt(0,0,0),L=0,R=!1,D=null,N=null,B=null,C=null,z=null,$=n.getParameter(n.MAX_COMBINED_TEXTURE_IMAGE_UNITS),G=!1,st=0,X=n.getParameter(n.VERSION);X.indexOf("WebGL")!==-1?(st=parseFloat(/^WebGL (\d)/.exec(X)[1]),G=st>=1):X.indexOf("OpenGL ES")!==-1&&(st=parseFloat(/^OpenGL ES (\d)/.exec(X)[1]),G=st>=2);let Z=null,it={},Mt=n.getParameter(n.SCISSOR_BOX),Dt=n.getParameter(n.VIEWPORT),j=new oe().fromArray(Mt),W=new oe().fromArray(Dt);function et(I,tt,Y,pt){let lt=new Uint8Array(4),ft=n.createTexture();n.bindTexture(I,ft),n.texParameteri(I,n.TEXTURE_MIN_FILTER,n.NEAREST),n.texParameteri(I,n.TEXTURE_MAG_FILTER,n.NEAREST);for(let It=0;It<Y;It++)I===n.TEXTURE_3D||I===n.TEXTURE_2D_ARRAY?n.texImage3D(tt,0,n.RGBA,1,1,pt,0,n.RGBA,n.UNSIGNED_BYTE,lt):n.texImage2D(tt+It,0,n.RGBA,1,1,0,n.RGBA,n.UNSIGNED_BYTE,lt);return ft}let ot={};ot[n.TEXTURE_2D]=et(n.TEXTURE_2D,n.TEXTURE_2D,1),ot[n.TEXTURE_CUBE_MAP]=et(n.TEXTURE_CUBE_MAP,n.TEXTURE_CUBE_MAP_POSITIVE_X,6),ot[n.TEXTURE_2D_ARRAY]=et(n.TEXTURE_2D_ARRAY,n.TEXTURE_2D_ARRAY,1,1),ot[n.TEXTURE_3D]=et(n.TEXTURE_3D,n.TEXTURE_3D,1,1),r.setClear(0,0,0,1),o.setClear(1),a.setClear(0),O(n.DEPTH_TEST),o.setFunc(yr),xe(!1),jt(Sf),O(n.CULL_FACE),qt(Ps);function O(I){h[I]!==!0&&(n.enable(I),h[I]=!0)}function K(I){h[I]!==!1&&(n.disable(I),h[I]=!1)}function Tt(I,tt){return f[I]!==tt?(n.bindFramebuffer(I,tt),f[I]=tt,I===n.DRAW_FRAMEBUFFER&&(f[n.FRAMEBUFFER]=tt),I===n.FRAMEBUFFER&&(f[n.DRAW_FRAMEBUFFER]=tt),!0):!1}function ct(I,tt){let Y=m,pt=!1;if(I){Y=d.get(tt),Y===void 0&&(Y=[],d.set(tt,Y));let lt=I.textures;if(Y.length!==lt.length||Y[0]!==n.COLOR_ATTACHMENT0){for(let ft=0,It=lt.length;ft<It;ft++)Y[ft]=n.COLOR_ATTACHMENT0+ft;Y.length=lt.length,pt=!0}}else Y[0]!==n.BACK&&(Y[0]=n.BACK,pt=!0);pt&&n.drawBuffers(Y)}function Rt(I){return _!==I?(n.useProgram(I),_=I,!0):!1}let St={[Is]:n.FUNC_ADD,[n0]:n.FUNC_SUBTRACT,[i0]:n.FUNC_REVERSE_SUBTRACT};St[s0]=n.MIN,St[r0]=n.MAX;let Pt={[o0]:n.ZERO,[a0]:n.ONE,[l0]:n.SRC_COLOR,[Tf]:n.SRC_ALPHA,[p0]:n.SRC_ALPHA_SATURATE,[f0]:n.DST_COLOR,[h0]:n.DST_ALPHA,[c0]:n.ONE_MINUS_SRC_COLOR,[Cf]:n.ONE_MINUS_SRC_ALPHA,[d0]:n.ONE_MINUS_DST_COLOR,[u0]:n.ONE_MINUS_DST_ALPHA,[m0]:n.CONSTANT_COLOR,[g0]:n.ONE_MINUS_CONSTANT_COLOR,[_0]:n.CONSTANT_ALPHA,[x0]:n.ONE_MINUS_CONSTANT_ALPHA};function qt(I,tt,Y,pt,lt,ft,It,Wt,at,Lt){if(I===Ps){p===!0&&(K(n.BLEND),p=!1);return}if(p===!1&&(O(n.BLEND),p=!0),I!==e0){if(I!==g||Lt!==R){if((x!==Is||w!==Is)&&(n.blendEquation(n.FUNC_ADD),x=Is,w=Is),Lt)switch(I){case Ur:n.blendFuncSeparate(n.ONE,n.ONE_MINUS_SRC_ALPHA,n.ONE,n.ONE_MINUS_SRC_ALPHA);break;case wf:n.blendFunc(n.ONE,n.ONE);break;case Af:n.blendFuncSeparate(n.ZERO,n.ONE_MINUS_SRC_COLOR,n.ZERO,n.ONE);break;case Ef:n.blendFuncSeparate(n.DST_COLOR,n.ONE_MINUS_SRC_ALPHA,n.ZERO,n.ONE);break;default:Ot("WebGLState: Invalid blending: ",I);break}else switch(I){case Ur:n.blendFuncSeparate(n.SRC_ALPHA,n.ONE_MINUS_SRC_ALPHA,n.ONE,n.ONE_MINUS_SRC_ALPHA);break;case wf:n.blendFuncSeparate(n.SRC_ALPHA,n.ONE,n.ONE,n.ONE);break;case Af:Ot("WebGLState: SubtractiveBlending requires material.premultipliedAlpha = true");break;case Ef:Ot("WebGLState: MultiplyBlending requires material.premultipliedAlpha = true");break;default:Ot("WebGLState: Invalid blending: ",I);break}b=null,v=null,E=null,y=null,M.set(0,0,0),L=0,g=I,R=Lt}return}lt=lt||tt,ft=ft||Y,It=It||pt,(tt!==x||lt!==w)&&(n.blendEquationSeparate(St[tt],St[lt]),x=tt,w=lt),(Y!==b||pt!==v||ft!==E||It!==y)&&(n.blendFuncSeparate(Pt[Y],Pt[pt],Pt[ft],Pt[It]),b=Y,v=pt,E=ft,y=It),(Wt.equals(M)===!1||at!==L)&&(n.blendColor(Wt.r,Wt.g,Wt.b,at),M.copy(Wt),L=at),g=I,R=!1}function ee(I,tt){I.side===Tn?K(n.CULL_FACE):O(n.CULL_FACE);let Y=I.side===Ue;tt&&(Y=!Y),xe(Y),I.blending===Ur&&I.transparent===!1?qt(Ps):qt(I.blending,I.blendEquation,I.blendSrc,I.blendDst,I.blendEquationAlpha,I.blendSrcAlpha,I.blendDstAlpha,I.blendColor,I.blendAlpha,I.premultipliedAlpha),o.setFunc(I.depthFunc),o.setTest(I.depthTest),o.setMask(I.depthWrite),r.setMask(I.colorWrite);let pt=I.stencilWrite;a.setTest(pt),pt&&(a.setMask(I.stencilWriteMask),a.setFunc(I.stencilFunc,I.stencilRef,I.stencilFuncMask),a.setOp(I.stencilFail,I.stencilZFail,I.stencilZPass)),Qt(I.polygonOffset,I.polygonOffsetFactor,I.polygonOffsetUnits),I.alphaToCoverage===!0?O(n.SAMPLE_ALPHA_TO_COVERAGE):K(n.SAMPLE_ALPHA_TO_COVERAGE)}function xe(I){D!==I&&(I?n.frontFace(n.CW):n.frontFace(n.CCW),D=I)}function jt(I){I!==Kg?(O(n.CULL_FACE),I!==N&&(I===Sf?n.cullFace(n.BACK):I===Qg?n.cullFace(n.FRONT):n.cullFace(n.FRONT_AND_BACK))):K(n.CULL_FACE),N=I}function le(I){I!==B&&(G&&n.lineWidth(I),B=I)}function Qt(I,tt,Y){I?(O(n.POLYGON_OFFSET_FILL),(C!==tt||z!==Y)&&(C=tt,z=Y,o.getReversed()&&(tt=-tt,Y=-Y),n.polygonOffset(tt,Y))):K(n.POLYGON_OFFSET_FILL)}function ke(I){I?O(n.SCISSOR_TEST):K(n.SCISSOR_TEST)}function mn(I){I===void 0&&(I=n.TEXTURE0+$-1),Z!==I&&(n.activeTexture(I),Z=I)}function gn(I,tt,Y){Y===void 0&&(Z===null?Y=n.TEXTURE0+$-1:Y=Z);let pt=it[Y];pt===void 0&&(pt={type:void 0,texture:void 0},it[Y]=pt),(pt.type!==I||pt.texture!==tt)&&(Z!==Y&&(n.activeTexture(Y),Z=Y),n.bindTexture(I,tt||ot[I]),pt.type=I,pt.texture=tt)}function F(){let I=it[Z];I!==void 0&&I.type!==void 0&&(n.bindTexture(I.type,null),I.type=void 0,I.texture=void 0)}function _n(){try{n.compressedTexImage2D(...arguments)}catch(I){Ot("WebGLState:",I)}}function pe(){try{n.compressedTexImage3D(...arguments)}catch(I){Ot("WebGLState:",I)}}function me(){try{n.texSubImage2D(...arguments)}catch(I){Ot("WebGLState:",I)}}function yt(){try{n.texSubImage3D(...arguments)}catch(I){Ot("WebGLState:",I)}}function Me(){try{n.compressedTexSubImage2D(...arguments)}catch(I){Ot("WebGLState:",I)}}function Ut(){try{n.compressedTexSubImage3D(...arguments)}catch(I){Ot("WebGLState:",I)}}function kt(){try{n.texStorage2D(...arguments)}catch(I){Ot("WebGLState:",I)}}function T(){try{n.texStorage3D(...arguments)}catch(I){Ot("WebGLState:",I)}}function S(){try{n.texImage2D(...arguments)}catch(I){Ot("WebGLState:",I)}}function V(){try{n.texImage3D(...arguments)}catch(I){Ot("WebGLState:",I)}}function rt(I){return u[I]!==void 0?u[I]:n.getParameter(I)}function nt(I,tt){u[I]!==tt&&(n.pixelStorei(I,tt),u[I]=tt)}function ut(I){j.equals(I)===!1&&(n.scissor(I.x,I.y,I.z,I.w),j.copy(I))}function gt(I){W.equals(I)===!1&&(n.viewport(I.x,I.y,I.z,I.w),W.copy(I))}function J(I,tt){let Y=l.get(tt);Y===void 0&&(Y=new WeakMap,l.set(tt,Y));let pt=Y.get(I);pt===void 0&&(pt=n.getUniformBlockIndex(tt,I.name),n.uniformBlockBinding(tt,pt,pt),Y.set(I,pt))}function Q(I,tt,Y){let lt=l.get(tt).get(I);c[lt]!==Y&&(n.bindBufferBase(n.UNIFORM_BUFFER,lt,Y),c[lt]=Y)}function dt(){n.disable(n.BLEND),n.disable(n.CULL_FACE),n.disable(n.DEPTH_TEST),n.disable(n.POLYGON_OFFSET_FILL),n.disable(n.SCISSOR_TEST),n.disable(n.STENCIL_TEST),n.disable(n.SAMPLE_ALPHA_TO_COVERAGE),n.blendEquation(n.FUNC_ADD),n.blendFunc(n.ONE,n.ZERO),n.blendFuncSeparate(n.ONE,n.ZERO,n.ONE,n.ZERO),n.blendColor(0,0,0,0),n.colorMask(!0,!0,!0,!0),n.clearColor(0,0,0,0),n.depthMask(!0),n.depthFunc(n.LESS),o.setReversed(!1),n.clearDepth(1),n.stencilMask(4294967295),n.stencilFunc(n.ALWAYS,0,4294967295),n.stencilOp(n.KEEP,n.KEEP,n.KEEP),n.clearStencil(0),n.cullFace(n.BACK),n.frontFace(n.CCW),n.polygonOffset(0,0),n.activeTexture(n.TEXTURE0),n.bindFramebuffer(n.FRAMEBUFFER,null),n.bindFramebuffer(n.DRAW_FRAMEBUFFER,null),n.bindFramebuffer(n.READ_FRAMEBUFFER,null),n.useProgram(null),n.lineWidth(1),n.scissor(0,0,n.canvas.width,n.canvas.height),n.viewport(0,0,n.canvas.width,n.canvas.height),n.pixelStorei(n.PACK_ALIGNMENT,4),n.pixelStorei(n.UNPACK_ALIGNMENT,4),n.pixelStorei(n.UNPACK_FLIP_Y_WEBGL,!1),n.pixelStorei(n.UNPACK_PREMULTIPLY_ALPHA_WEBGL,!1),n.pixelStorei(n.UNPACK_COLORSPACE_CONVERSION_WEBGL,n.BROWSER_DEFAULT_WEBGL),n.pixelStorei(n.PACK_ROW_LENGTH,0),n.pixelStorei(n.PACK_SKIP_PIXELS,0),n.pixelStorei(n.PACK_SKIP_ROWS,0),n.pixelStorei(n.UNPACK_ROW_LENGTH,0),n.pixelStorei(n.UNPACK_IMAGE_HEIGHT,0),n.pixelStorei(n.UNPACK_SKIP_PIXELS,0),n.pixelStorei(n.UNPACK_SKIP_ROWS,0),n.pixelStorei(n.UNPACK_SKIP_IMAGES,0),h={},u={},Z=null,it={},f={},c={},d=new WeakMap,m=[],_=null,p=!1,g=null,x=null,b=null,v=null,w=null,E=null,y=null,M=new Gt(0,0,0),L=0,R=!1,D=null,N=null,B=null,C=null,z=null,j.set(0,0,n.canvas.width,n.canvas.height),W.set(0,0,n.canvas.width,n.canvas.height),r.reset(),o.reset(),a.reset()}return{buffers:{color:r,depth:o,stencil:a},enable:O,disable:K,bindFramebuffer:Tt,drawBuffers:ct,useProgram:Rt,setBlending:qt,setMaterial:ee,setFlipSided:xe,setCullFace:jt,setLineWidth:le,setPolygonOffset:Qt,setScissorTest:ke,activeTexture:mn,bindTexture:gn,unbindTexture:F,compressedTexImage2D:_n,compressedTexImage3D:pe,texImage2D:S,texImage3D:V,pixelStorei:nt,getParameter:rt,updateUBOMapping:J,uniformBlockBinding:Q,texStorage2D:kt,texStorage3D:T,texSubImage2D:me,texSubImage3D:yt,compressedTexSubImage2D:Me,compressedTexSubImage3D:Ut,scissor:ut,viewport:gt,reset:dt}}function IA(n,t,e,i,s,r,o){let a=t.has("WEBGL_multisampled_render_to_texture")?t.get("WEBGL_multisampled_render_to_texture"):null,c=typeof navigator>"u"?!1:/OculusBrowser/g.test(navigator.userAgent),l=new ht,h=new WeakMap,u=new Set,f,d=new WeakMap,m=new Set,_=new FinalizationRegistry(T=>m.delete(T)),p=!1;try{p=typeof OffscreenCanvas<"u"&&new OffscreenCanvas(1,1).getContext("2d")!==null}catch{}function g(T,S){return p?new OffscreenCanvas(T,S):bo("canvas")}function x(T,S,V){let rt=1,nt=kt(T);if((nt.width>V||nt.height>V)&&(rt=V/Math.max(nt.width,nt.height)),rt<1)if(typeof HTMLImageElement<"u"&&T instanceof HTMLImageElement||typeof HTMLCanvasElement<"u"&&T instanceof HTMLCanvasElement||typeof ImageBitmap<"u"&&T instanceof ImageBitmap||typeof VideoFrame<"u"&&T instanceof VideoFrame){let ut=Math.floor(rt*nt.width),gt=Math.floor(rt*nt.height);f===void 0&&(f=g(ut,gt));let J=S?g(ut,gt):f;return J.width=ut,J.height=gt,J.getContext("2d").drawImage(T,0,0,ut,gt),Nt("WebGLRenderer: Texture has been resized from ("+nt.width+"x"+nt.height+") to ("+ut+"x"+gt+")."),J}else return"data"in T&&Nt("WebGLRenderer: Image in DataTexture is too big ("+nt.width+"x"+nt.height+")."),T;return T}function b(T){return T.generateMipmaps}function v(T){n.generateMipmap(T)}function w(T){return T.isWebGLCubeRenderTarget?n.TEXTURE_CUBE_MAP:T.isWebGL3DRenderTarget?n.TEXTURE_3D:T.isWebGLArrayRenderTarget||T.isCompressedArrayTexture?n.TEXTURE_2D_ARRAY:n.TEXTURE_2D}function E(T,S,V,rt,nt,ut=!1){if(T!==null){if(n[T]!==void 0)return n[T];Nt("WebGLRenderer: Attempt to use non-existing WebGL internal format '"+T+"'")}let gt;rt&&(gt=t.get("EXT_texture_norm16"),gt||Nt("WebGLRenderer: Unable to use normalized textures without EXT_texture_norm16 extension"));let J=S;if(S===n.RED&&(V===n.FLOAT&&(J=n.R32F),V===n.HALF_FLOAT&&(J=n.R16F),V===n.UNSIGNED_BYTE&&(J=n.R8),V===n.UNSIGNED_SHORT&&gt&&(J=gt.R16_EXT),V===n.SHORT&&gt&&(J=gt.R16_SNORM_EXT)),S===n.RED_INTEGER&&(V===n.UNSIGNED_BYTE&&(J=n.R8UI),V===n.UNSIGNED_SHORT&&(J=n.R16UI),V===n.UNSIGNED_INT&&(J=n.R32UI),V===n.BYTE&&(J=n.R8I),V===n.SHORT&&(J=n.R16I),V===n.INT&&(J=n.R32I)),S===n.RG&&(V===n.FLOAT&&(J=n.RG32F),V===n.HALF_FLOAT&&(J=n.RG16F),V===n.UNSIGNED_BYTE&&(J=n.RG8),V===n.UNSIGNED_SHORT&&gt&&(J=gt.RG16_EXT),V===n.SHORT&&gt&&(J=gt.RG16_SNORM_EXT)),S===n.RG_INTEGER&&(V===n.UNSIGNED_BYTE&&(J=n.RG8UI),V===n.UNSIGNED_SHORT&&(J=n.RG16UI),V===n.UNSIGNED_INT&&(J=n.RG32UI),V===n.BYTE&&(J=n.RG8I),V===n.SHORT&&(J=n.RG16I),V===n.INT&&(J=n.RG32I)),S===n.RGB_INTEGER&&(V===n.UNSIGNED_BYTE&&(J=n.RGB8UI),V===n.UNSIGNED_SHORT&&(J=n.RGB16UI),V===n.UNSIGNED_INT&&(J=n.RGB32UI),V===n.BYTE&&(J=n.RGB8I),V===n.SHORT&&(J=n.RGB16I),V===n.INT&&(J=n.RGB32I)),S===n.RGBA_INTEGER&&(V===n.UNSIGNED_BYTE&&(J=n.RGBA8UI),V===n.UNSIGNED_SHORT&&(J=n.RGBA16UI),V===n.UNSIGNED_INT&&(J=n.RGBA32UI),V===n.BYTE&&(J=n.RGBA8I),V===n.SHORT&&(J=n.RGBA16I),V===n.INT&&(J=n.RGBA32I)),S===n.RGB&&(V===n.UNSIGNED_SHORT&&gt&&(J=gt.RGB16_EXT),V===n.SHORT&&gt&&(J=gt.RGB16_SNORM_EXT),V===n.UNSIGNED_INT_5_9_9_9_REV&&(J=n.RGB9_E5),V===n.UNSIGNED_INT_10F_11F_11F_REV&&(J=n.R11F_G11F_B10F)),S===n.RGBA){let Q=ut?vo:Jt.getTransfer(nt);V===n.FLOAT&&(J=n.RGBA32F),V===n.HALF_FLOAT&&(J=n.RGBA16F),V===n.UNSIGNED_BYTE&&(J=Q===se?n.SRGB8_ALPHA8:n.RGBA8),V===n.UNSIGNED_SHORT&&gt&&(J=gt.RGBA16_EXT),V===n.SHORT&&gt&&(J=gt.RGBA16_SNORM_EXT),V===n.UNSIGNED_SHORT_4_4_4_4&&(J=n.RGBA4),V===n.UNSIGNED_SHORT_5_5_5_1&&(J=n.RGB5_A1)}return(J===n.R16F||J===n.R32F||J===n.RG16F||J===n.RG32F||J===n.RGBA16F||J===n.RGBA32F)&&t.get("EXT_color_buffer_float"),J}function y(T,S){let V;return T?S===null||S===kn||S===Ns?V=n.DEPTH24_STENCIL8:S===zn?V=n.DEPTH32F_STENCIL8:S===Fr&&(V=n.DEPTH24_STENCIL8,Nt("DepthTexture: 16 bit depth attachment is not supported with stencil. Using 24-bit attachment.")):S===null||S===kn||S===Ns?V=n.DEPTH_COMPONENT24:S===zn?V=n.DEPTH_COMPONENT32F:S===Fr&&(V=n.DEPTH_COMPONENT16),V}function M(T,S){return b(T)===!0||T.isFramebufferTexture&&T.minFilter!==Pe&&T.minFilter!==Ke?Math.log2(Math.max(S.width,S.height))+1:T.mipmaps.length>0?T.mipmaps.length:T.isCompressedTexture&&Array.isArray(T.image)?S.mipmaps.length:1}function L(T){let S=new WeakRef(T);i.get(T).__ref=S,m.add(S),_.register(T,S,S)}function R(T){let S=i.get(T).__ref;S!==void 0&&(m.delete(S),_.unregister(S))}function D(T){B(T.target)}function N(T){C(T.target)}function B(T){T.removeEventListener("dispose",D),R(T),$(T),T.isVideoTexture&&h.delete(T),T.isHTMLTexture&&u.delete(T)}function C(T){T.removeEventListener("dispose",N),R(T),st(T)}function z(){for(let T of m){let S=T.deref();S!==void 0&&(S.isRenderTarget===!0?C(S):B(S))}m.clear(),u.clear()}function $(T){let S=i.get(T);if(S.__webglInit===void 0)return;let V=T.source,rt=d.get(V);if(rt){let nt=rt[S.__cacheKey];nt.usedTimes--,nt.usedTimes===0&&G(T),Object.keys(rt).length===0&&d.delete(V)}i.remove(T)}function G(T){let S=i.get(T);n.deleteTexture(S.__webglTexture);let V=T.source,rt=d.get(V);delete rt[S.__cacheKey],o.memory.textures--}function st(T){let S=i.get(T);S.__depthDisposeCallback&&S.__depthDisposeCallback();let V=T.depthTexture;if(V&&V.renderTarget===T&&B(V),T.isWebGLCubeRenderTarget)for(let nt=0;nt<6;nt++){if(Array.isArray(S.__webglFramebuffer[nt]))for(let ut=0;ut<S.__webglFramebuffer[nt].length;ut++)n.deleteFramebuffer(S.__webglFramebuffer[nt][ut]);else n.deleteFramebuffer(S.__webglFramebuffer[nt]);S.__webglDepthbuffer&&n.deleteRenderbuffer(S.__webglDepthbuffer[nt])}else{if(Array.isArray(S.__webglFramebuffer))for(let nt=0;nt<S.__webglFramebuffer.length;nt++)n.deleteFramebuffer(S.__webglFramebuffer[nt]);else n.deleteFramebuffer(S.__webglFramebuffer);if(S.__webglDepthbuffer&&n.deleteRenderbuffer(S.__webglDepthbuffer),S.__webglMultisampledFramebuffer&&n.deleteFramebuffer(S.__webglMultisampledFramebuffer),S.__webglColorRenderbuffer)for(let nt=0;nt<S.__webglColorRenderbuffer.length;nt++)S.__webglColorRenderbuffer[nt]&&n.deleteRenderbuffer(S.__webglColorRenderbuffer[nt]);S.__webglDepthRenderbuffer&&n.deleteRenderbuffer(S.__webglDepthRenderbuffer)}let rt=T.textures;for(let nt=0,ut=rt.length;nt<ut;nt++){let gt=i.get(rt[nt]);gt.__webglTexture&&(n.deleteTexture(gt.__webglTexture),o.memory.textures--),i.remove(rt[nt])}i.remove(T)}let X=0;function Z(){X=0}function it(){return X}function Mt(T){X=T}function Dt(){let T=X;return T>=s.maxTextures&&Nt("WebGLTextures: Trying to use "+(T+1)+" texture units while this GPU supports only "+s.maxTextures),X+=1,T}function j(T){let S=[];return S.push(T.wrapS),S.push(T.wrapT),S.push(T.wrapR||0),S.push(T.magFilter),S.push(T.minFilter),S.push(T.anisotropy),S.push(T.internalFormat),S.push(T.format),S.push(T.type),S.push(T.generateMipmaps),S.push(T.mipmapsAutoUpdate),S.push(T.premultiplyAlpha),S.push(T.flipY),S.push(T.unpackAlignment),S.push(T.colorSpace),S.join()}function W(T,S){let V=i.get(T);if(T.isVideoTexture&&Me(T),T.isRenderTargetTexture===!1&&T.isExternalTexture!==!0&&T.version>0&&V.__version!==T.version){let rt=T.image;if(rt===null)Nt("WebGLRenderer: Texture marked for update but no image data found.");else if(rt.complete===!1)Nt("WebGLRenderer: Texture marked for update but image is incomplete");else{ee(V,T,S);return}}else T.isExternalTexture&&(V.__webglTexture=T.sourceTexture?T.sourceTexture:null);e.bindTexture(n.TEXTURE_2D,V.__webglTexture,n.TEXTURE0+S)}function et(T,S){let V=i.get(T);if(T.isRenderTargetTexture===!1&&T.version>0&&V.__version!==T.version){ee(V,T,S);return}else T.isExternalTexture&&(V.__webglTexture=T.sourceTexture?T.sourceTexture:null);e.bindTexture(n.TEXTURE_2D_ARRAY,V.__webglTexture,n.TEXTURE0+S)}function ot(T,S){let V=i.get(T);if(T.isRenderTargetTexture===!1&&T.version>0&&V.__version!==T.version){ee(V,T,S);return}e.bindTexture(n.TEXTURE_3D,V.__webglTexture,n.TEXTURE0+S)}function O(T,S){let V=i.get(T);if(T.version>0&&V.__version!==T.version){xe(V,T,S);return}e.bindTexture(n.TEXTURE_CUBE_MAP,V.__webglTexture,n.TEXTURE0+S)}let K={[Ol]:n.REPEAT,[qn]:n.CLAMP_TO_EDGE,[Fl]:n.MIRRORED_REPEAT},Tt={[Pe]:n.NEAREST,[b0]:n.NEAREST_MIPMAP_NEAREST,[Qo]:n.NEAREST_MIPMAP_LINEAR,[Ke]:n.LINEAR,[xc]:n.LINEAR_MIPMAP_NEAREST,[bi]:n.LINEAR_MIPMAP_LINEAR},ct={[A0]:n.NEVER,[$f]:n.ALWAYS,[E0]:n.LESS,[Wf]:n.LEQUAL,[T0]:n.EQUAL,[Xf]:n.GEQUAL,[C0]:n.GREATER,[R0]:n.NOTEQUAL};function Rt(T,S){if(S.type===zn&&t.has("OES_texture_float_linear")===!1&&(S.magFilter===Ke||S.magFilter===xc||S.magFilter===Qo||S.magFilter===bi||S.minFilter===Ke||S.minFilter===xc||S.minFilter===Qo||S.minFilter===bi)&&Nt("WebGLRenderer: Unable to use linear filtering with floating point textures. OES_texture_float_linear not supported on this device."),n.texParameteri(T,n.TEXTURE_WRAP_S,K[S.wrapS]),n.texParameteri(T,n.TEXTURE_WRAP_T,K[S.wrapT]),(T===n.TEXTURE_3D||T===n.TEXTURE_2D_ARRAY)&&n.texParameteri(T,n.TEXTURE_WRAP_R,K[S.wrapR]),n.texParameteri(T,n.TEXTURE_MAG_FILTER,Tt[S.magFilter]),n.texParameteri(T,n.TEXTURE_MIN_FILTER,Tt[S.minFilter]),S.compareFunction&&(n.texParameteri(T,n.TEXTURE_COMPARE_MODE,n.COMPARE_REF_TO_TEXTURE),n.texParameteri(T,n.TEXTURE_COMPARE_FUNC,ct[S.compareFunction])),t.has("EXT_texture_filter_anisotropic")===!0){if(S.magFilter===Pe||S.minFilter!==Qo&&S.minFilter!==bi||S.type===zn&&t.has("OES_texture_float_linear")===!1)return;if(S.anisotropy>1||i.get(S).__currentAnisotropy){let V=t.get("EXT_texture_filter_anisotropic");n.texParameterf(T,V.TEXTURE_MAX_ANISOTROPY_EXT,Math.min(S.anisotropy,s.getMaxAnisotropy())),i.get(S).__currentAnisotropy=S.anisotropy}}}function St(T,S){let V=!1;T.__webglInit===void 0&&(T.__webglInit=!0,S.addEventListener("dispose",D),L(S));let rt=S.source,nt=d.get(rt);nt===void 0&&(nt={},d.set(rt,nt));let ut=j(S);if(ut!==T.__cacheKey){nt[ut]===void 0&&(nt[ut]={texture:n.createTexture(),usedTimes:0},o.memory.textures++,V=!0),nt[ut].usedTimes++;let gt=nt[T.__cacheKey];gt!==void 0&&(nt[T.__cacheKey].usedTimes--,gt.usedTimes===0&&G(S)),T.__cacheKey=ut,T.__webglTexture=nt[ut].texture}return V}function Pt(T,S,V){return Math.floor(Math.floor(T/V)/S)}function qt(T,S,V,rt){let ut=T.updateRanges;if(ut.length===0)e.texSubImage2D(n.TEXTURE_2D,0,0,0,S.width,S.height,V,rt,S.data);else{ut.sort((I,tt)=>I.start-tt.start);let gt=0;for(let I=1;I<ut.length;I++){let tt=ut[gt],Y=ut[I],pt=tt.start+tt.count,lt=Pt(Y.start,S.width,4),ft=Pt(tt.start,S.width,4);Y.start<=pt+1&&lt===ft&&Pt(Y.start+Y.count-1,S.width,4)===lt?tt.count=Math.max(tt.count,Y.start+Y.count-tt.start):(++gt,ut[gt]=Y)}ut.length=gt+1;let J=e.getParameter(n.UNPACK_ROW_LENGTH),Q=e.getParameter(n.UNPACK_SKIP_PIXELS),dt=e.getParameter(n.UNPACK_SKIP_ROWS);e.pixelStorei(n.UNPACK_ROW_LENGTH,S.width);for(let I=0,tt=ut.length;I<tt;I++){let Y=ut[I],pt=Math.floor(Y.start/4),lt=Math.ceil(Y.count/4),ft=pt%S.width,It=Math.floor(pt/S.width),Wt=lt,at=1;e.pixelStorei(n.UNPACK_SKIP_PIXELS,ft),e.pixelStorei(n.UNPACK_SKIP_ROWS,It),e.texSubImage2D(n.TEXTURE_2D,0,ft,It,Wt,at,V,rt,S.data)}T.clearUpdateRanges(),e.pixelStorei(n.UNPACK_ROW_LENGTH,J),e.pixelStorei(n.UNPACK_SKIP_PIXELS,Q),e.pixelStorei(n.UNPACK_SKIP_ROWS,dt)}}function ee(T,S,V){let rt=n.TEXTURE_2D;(S.isDataArrayTexture||S.isCompressedArrayTexture)&&(rt=n.TEXTURE_2D_ARRAY),S.isData3DTexture&&(rt=n.TEXTURE_3D);let nt=St(T,S),ut=S.source;e.bindTexture(rt,T.__webglTexture,n.TEXTURE0+V);let gt=i.get(ut);if(ut.version!==gt.__version||nt===!0){if(e.activeTexture(n.TEXTURE0+V),(typeof ImageBitmap<"u"&&S.image instanceof ImageBitmap)===!1){let at=Jt.getPrimaries(Jt.workingColorSpace),Lt=S.colorSpace===Si?null:Jt.getPrimaries(S.colorSpace),Ht=S.colorSpace===Si||at===Lt?n.NONE:n.BROWSER_DEFAULT_WEBGL;e.pixelStorei(n.UNPACK_FLIP_Y_WEBGL,S.flipY),e.pixelStorei(n.UNPACK_PREMULTIPLY_ALPHA_WEBGL,S.premultiplyAlpha),e.pixelStorei(n.UNPACK_COLORSPACE_CONVERSION_WEBGL,Ht)}e.pixelStorei(n.UNPACK_ALIGNMENT,S.unpackAlignment);let Q=x(S.image,!1,s.maxTextureSize);Q=Ut(S,Q);let dt=r.convert(S.format,S.colorSpace),I=r.convert(S.type),tt=E(S.internalFormat,dt,I,S.normalized,S.colorSpace,S.isVideoTexture);Rt(rt,S);let Y,pt=S.mipmaps,lt=S.isVideoTexture!==!0,ft=gt.__version===void 0||nt===!0,It=ut.dataReady,Wt=M(S,Q);if(S.isDepthTexture)tt=y(S.format===Mi,S.type),ft&&(lt?e.texStorage2D(n.TEXTURE_2D,1,tt,Q.width,Q.height):e.texImage2D(n.TEXTURE_2D,0,tt,Q.width,Q.height,0,dt,I,null));else if(S.isDataTexture)if(pt.length>0){lt&&ft&&e.texStorage2D(n.TEXTURE_2D,Wt,tt,pt[0].width,pt[0].height);for(let at=0,Lt=pt.length;at<Lt;at++)Y=pt[at],lt?It&&e.texSubImage2D(n.TEXTURE_2D,at,0,0,Y.width,Y.height,dt,I,Y.data):e.texImage2D(n.TEXTURE_2D,at,tt,Y.width,Y.height,0,dt,I,Y.data);S.generateMipmaps=!1}else lt?(ft&&e.texStorage2D(n.TEXTURE_2D,Wt,tt,Q.width,Q.height),It&&qt(S,Q,dt,I)):e.texImage2D(n.TEXTURE_2D,0,tt,Q.width,Q.height,0,dt,I,Q.data);else if(S.isCompressedTexture)if(S.isCompressedArrayTexture){lt&&ft&&e.texStorage3D(n.TEXTURE_2D_ARRAY,Wt,tt,pt[0].width,pt[0].height,Q.depth);for(let at=0,Lt=pt.length;at<Lt;at++)if(Y=pt[at],S.format!==Gn)if(dt!==null)if(lt){if(It)if(S.layerUpdates.size>0){let Ht=id(Y.width,Y.height,S.format,S.type);for(let vt of S.layerUpdates){let ce=Y.data.subarray(vt*Ht/Y.data.BYTES_PER_ELEMENT,(vt+1)*Ht/Y.data.BYTES_PER_ELEMENT);e.compressedTexSubImage3D(n.TEXTURE_2D_ARRAY,at,0,0,vt,Y.width,Y.height,1,dt,ce)}}else e.compressedTexSubImage3D(n.TEXTURE_2D_ARRAY,at,0,0,0,Y.width,Y.height,Q.depth,dt,Y.data)}else e.compressedTexImage3D(n.TEXTURE_2D_ARRAY,at,tt,Y.width,Y.height,Q.depth,0,Y.data,0,0);else Nt("WebGLRenderer: Attempt to load unsupported compressed texture format in .uploadTexture()");else lt?It&&e.texSubImage3D(n.TEXTURE_2D_ARRAY,at,0,0,0,Y.width,Y.height,Q.depth,dt,I,Y.data):e.texImage3D(n.TEXTURE_2D_ARRAY,at,tt,Y.width,Y.height,Q.depth,0,dt,I,Y.data);S.layerUpdates.size>0&&S.clearLayerUpdates()}else{lt&&ft&&e.texStorage2D(n.TEXTURE_2D,Wt,tt,pt[0].width,pt[0].height);for(let at=0,Lt=pt.length;at<Lt;at++)Y=pt[at],S.format!==Gn?dt!==null?lt?It&&e.compressedTexSubImage2D(n.TEXTURE_2D,at,0,0,Y.width,Y.height,dt,Y.data):e.compressedTexImage2D(n.TEXTURE_2D,at,tt,Y.width,Y.height,0,Y.data):Nt("WebGLRenderer: Attempt to load unsupported compressed texture format in .uploadTexture()"):lt?It&&e.texSubImage2D(n.TEXTURE_2D,at,0,0,Y.width,Y.height,dt,I,Y.data):e.texImage2D(n.TEXTURE_2D,at,tt,Y.width,Y.height,0,dt,I,Y.data)}else if(S.isDataArrayTexture)if(lt){if(ft&&e.texStorage3D(n.TEXTURE_2D_ARRAY,Wt,tt,Q.width,Q.height,Q.depth),It)if(S.layerUpdates.size>0){let at=id(Q.width,Q.height,S.format,S.type);for(let Lt of S.layerUpdates){let Ht=Q.data.subarray(Lt*at/Q.data.BYTES_PER_ELEMENT,(Lt+1)*at/Q.data.BYTES_PER_ELEMENT);e.texSubImage3D(n.TEXTURE_2D_ARRAY,0,0,0,Lt,Q.width,Q.height,1,dt,I,Ht)}S.clearLayerUpdates()}else e.texSubImage3D(n.TEXTURE_2D_ARRAY,0,0,0,0,Q.width,Q.height,Q.depth,dt,I,Q.data)}else e.texImage3D(n.TEXTURE_2D_ARRAY,0,tt,Q.width,Q.height,Q.depth,0,dt,I,Q.data);else if(S.isData3DTexture)lt?(ft&&e.texStorage3D(n.TEXTURE_3D,Wt,tt,Q.width,Q.height,Q.depth),It&&e.texSubImage3D(n.TEXTURE_3D,0,0,0,0,Q.width,Q.height,Q.depth,dt,I,Q.data)):e.texImage3D(n.TEXTURE_3D,0,tt,Q.width,Q.height,Q.depth,0,dt,I,Q.data);else if(S.isFramebufferTexture){if(ft)if(lt)e.texStorage2D(n.TEXTURE_2D,Wt,tt,Q.width,Q.height);else{let at=Q.width,Lt=Q.height;for(let Ht=0;Ht<Wt;Ht++)e.texImage2D(n.TEXTURE_2D,Ht,tt,at,Lt,0,dt,I,null),at>>=1,Lt>>=1}}else if(S.isHTMLTexture){if("texElementImage2D"in n){let at=n.canvas;if(at.hasAttribute("layoutsubtree")||at.setAttribute("layoutsubtree","true"),Q.parentNode!==at){at.appendChild(Q),u.add(S),at.onpaint=Lt=>{let Ht=Lt.changedElements;for(let vt of u)Ht.includes(vt.image)&&(vt.needsUpdate=!0)},at.requestPaint();return}if(n.texElementImage2D.length===3)n.texElementImage2D(n.TEXTURE_2D,n.RGBA8,Q);else{let Ht=n.RGBA,vt=n.RGBA,ce=n.UNSIGNED_BYTE;n.texElementImage2D(n.TEXTURE_2D,0,Ht,vt,ce,Q)}n.texParameteri(n.TEXTURE_2D,n.TEXTURE_MIN_FILTER,n.LINEAR),n.texParameteri(n.TEXTURE_2D,n.TEXTURE_WRAP_S,n.CLAMP_TO_EDGE),n.texParameteri(n.TEXTURE_2D,n.TEXTURE_WRAP_T,n.CLAMP_TO_EDGE)}}else if(pt.length>0){if(lt&&ft){let at=kt(pt[0]);e.texStorage2D(n.TEXTURE_2D,Wt,tt,at.width,at.height)}for(let at=0,Lt=pt.length;at<Lt;at++)Y=pt[at],lt?It&&e.texSubImage2D(n.TEXTURE_2D,at,0,0,dt,I,Y):e.texImage2D(n.TEXTURE_2D,at,tt,dt,I,Y);S.generateMipmaps=!1}else if(lt){if(ft){let at=kt(Q);e.texStorage2D(n.TEXTURE_2D,Wt,tt,at.width,at.height)}It&&e.texSubImage2D(n.TEXTURE_2D,0,0,0,dt,I,Q)}else e.texImage2D(n.TEXTURE_2D,0,tt,dt,I,Q);b(S)&&S.mipmapsAutoUpdate===!0&&v(rt),gt.__version=ut.version,S.onUpdate&&S.onUpdate(S)}T.__version=S.version}function xe(T,S,V){if(S.image.length!==6)return;let rt=St(T,S),nt=S.source;e.bindTexture(n.TEXTURE_CUBE_MAP,T.__webglTexture,n.TEXTURE0+V);let ut=i.get(nt);if(nt.version!==ut.__version||rt===!0){e.activeTexture(n.TEXTURE0+V);let gt=Jt.getPrimaries(Jt.workingColorSpace),J=S.colorSpace===Si?null:Jt.getPrimaries(S.colorSpace),Q=S.colorSpace===Si||gt===J?n.NONE:n.BROWSER_DEFAULT_WEBGL;e.pixelStorei(n.UNPACK_FLIP_Y_WEBGL,S.flipY),e.pixelStorei(n.UNPACK_PREMULTIPLY_ALPHA_WEBGL,S.premultiplyAlpha),e.pixelStorei(n.UNPACK_ALIGNMENT,S.unpackAlignment),e.pixelStorei(n.UNPACK_COLORSPACE_CONVERSION_WEBGL,Q);let dt=S.isCompressedTexture||S.image[0].isCompressedTexture,I=S.image[0]&&S.image[0].isDataTexture,tt=[];for(let vt=0;vt<6;vt++)!dt&&!I?tt[vt]=x(S.image[vt],!0,s.maxCubemapSize):tt[vt]=I?S.image[vt].image:S.image[vt],tt[vt]=Ut(S,tt[vt]);let Y=tt[0],pt=r.convert(S.format,S.colorSpace),lt=r.convert(S.type),ft=E(S.internalFormat,pt,lt,S.normalized,S.colorSpace),It=S.isVideoTexture!==!0,Wt=ut.__version===void 0||rt===!0,at=nt.dataReady,Lt=M(S,Y);Rt(n.TEXTURE_CUBE_MAP,S);let Ht;if(S.isDepthTexture){if(ft=y(S.format===Mi,S.type),Wt)if(It)e.texStorage2D(n.TEXTURE_CUBE_MAP,1,ft,Y.width,Y.height);else for(let vt=0;vt<6;vt++)e.texImage2D(n.TEXTURE_CUBE_MAP_POSITIVE_X+vt,0,ft,Y.width,Y.height,0,pt,lt,null)}else if(dt){It&&Wt&&e.texStorage2D(n.TEXTURE_CUBE_MAP,Lt,ft,Y.width,Y.height);for(let vt=0;vt<6;vt++){Ht=tt[vt].mipmaps;for(let ce=0;ce<Ht.length;ce++){let Ee=Ht[ce];S.format!==Gn?pt!==null?It?at&&e.compressedTexSubImage2D(n.TEXTURE_CUBE_MAP_POSITIVE_X+vt,ce,0,0,Ee.width,Ee.height,pt,Ee.data):e.compressedTexImage2D(n.TEXTURE_CUBE_MAP_POSITIVE_X+vt,ce,ft,Ee.width,Ee.height,0,Ee.data):Nt("WebGLRenderer: Attempt to load unsupported compressed texture format in .setTextureCube()"):It?at&&e.texSubImage2D(n.TEXTURE_CUBE_MAP_POSITIVE_X+vt,ce,0,0,Ee.width,Ee.height,pt,lt,Ee.data):e.texImage2D(n.TEXTURE_CUBE_MAP_POSITIVE_X+vt,ce,ft,Ee.width,Ee.height,0,pt,lt,Ee.data)}}}else{if(Ht=S.mipmaps,It&&Wt){Ht.length>0&&Lt++;let vt=kt(tt[0]);e.texStorage2D(n.TEXTURE_CUBE_MAP,Lt,ft,vt.width,vt.height)}for(let vt=0;vt<6;vt++)if(I){It?at&&e.texSubImage2D(n.TEXTURE_CUBE_MAP_POSITIVE_X+vt,0,0,0,tt[vt].width,tt[vt].height,pt,lt,tt[vt].data):e.texImage2D(n.TEXTURE_CUBE_MAP_POSITIVE_X+vt,0,ft,tt[vt].width,tt[vt].height,0,pt,lt,tt[vt].data);for(let ce=0;ce<Ht.length;ce++){let Ei=Ht[ce].image[vt].image;It?at&&e.texSubImage2D(n.TEXTURE_CUBE_MAP_POSITIVE_X+vt,ce+1,0,0,Ei.width,Ei.height,pt,lt,Ei.data):e.texImage2D(n.TEXTURE_CUBE_MAP_POSITIVE_X+vt,ce+1,ft,Ei.width,Ei.height,0,pt,lt,Ei.data)}}else{It?at&&e.texSubImage2D(n.TEXTURE_CUBE_MAP_POSITIVE_X+vt,0,0,0,pt,lt,tt[vt]):e.texImage2D(n.TEXTURE_CUBE_MAP_POSITIVE_X+vt,0,ft,pt,lt,tt[vt]);for(let ce=0;ce<Ht.length;ce++){let Ee=Ht[ce];It?at&&e.texSubImage2D(n.TEXTURE_CUBE_MAP_POSITIVE_X+vt,ce+1,0,0,pt,lt,Ee.image[vt]):e.texImage2D(n.TEXTURE_CUBE_MAP_POSITIVE_X+vt,ce+1,ft,pt,lt,Ee.image[vt])}}}b(S)&&S.mipmapsAutoUpdate===!0&&v(n.TEXTURE_CUBE_MAP),ut.__version=nt.version,S.onUpdate&&S.onUpdate(S)}T.__version=S.version}function jt(T,S,V,rt,nt,ut){let gt=r.convert(V.format,V.colorSpace),J=r.convert(V.type),Q=E(V.internalFormat,gt,J,V.normalized,V.colorSpace),dt=i.get(S),I=i.get(V);if(I.__renderTarget=S,!dt.__hasExternalTextures){let tt=Math.max(1,S.width>>ut),Y=Math.max(1,S.height>>ut);nt===n.TEXTURE_3D||nt===n.TEXTURE_2D_ARRAY?e.texImage3D(nt,ut,Q,tt,Y,S.depth,0,gt,J,null):e.texImage2D(nt,ut,Q,tt,Y,0,gt,J,null)}e.bindFramebuffer(n.FRAMEBUFFER,T),yt(S)?a.framebufferTexture2DMultisampleEXT(n.FRAMEBUFFER,rt,nt,I.__webglTexture,0,me(S)):(nt===n.TEXTURE_2D||nt>=n.TEXTURE_CUBE_MAP_POSITIVE_X&&nt<=n.TEXTURE_CUBE_MAP_NEGATIVE_Z)&&n.framebufferTexture2D(n.FRAMEBUFFER,rt,nt,I.__webglTexture,ut),e.bindFramebuffer(n.FRAMEBUFFER,null)}function le(T,S,V){if(n.bindRenderbuffer(n.RENDERBUFFER,T),S.depthBuffer){let rt=S.depthTexture,nt=rt&&rt.isDepthTexture?rt.type:null,ut=y(S.stencilBuffer,nt),gt=S.stencilBuffer?n.DEPTH_STENCIL_ATTACHMENT:n.DEPTH_ATTACHMENT;yt(S)?a.renderbufferStorageMultisampleEXT(n.RENDERBUFFER,me(S),ut,S.width,S.height):V?n.renderbufferStorageMultisample(n.RENDERBUFFER,me(S),ut,S.width,S.height):n.renderbufferStorage(n.RENDERBUFFER,ut,S.width,S.height),n.framebufferRenderbuffer(n.FRAMEBUFFER,gt,n.RENDERBUFFER,T)}else{let rt=S.textures;for(let nt=0;nt<rt.length;nt++){let ut=rt[nt],gt=r.convert(ut.format,ut.colorSpace),J=r.convert(ut.type),Q=E(ut.internalFormat,gt,J,ut.normalized,ut.colorSpace);yt(S)?a.renderbufferStorageMultisampleEXT(n.RENDERBUFFER,me(S),Q,S.width,S.height):V?n.renderbufferStorageMultisample(n.RENDERBUFFER,me(S),Q,S.width,S.height):n.renderbufferStorage(n.RENDERBUFFER,Q,S.width,S.height)}}n.bindRenderbuffer(n.RENDERBUFFER,null)}function Qt(T,S,V){let rt=S.isWebGLCubeRenderTarget===!0;if(e.bindFramebuffer(n.FRAMEBUFFER,T),!(S.depthTexture&&S.depthTexture.isDepthTexture))throw new Error("THREE.WebGLTextures: renderTarget.depthTexture must be an instance of THREE.DepthTexture.");let nt=i.get(S.depthTexture);nt.__renderTarget=S;let ut=rt?S.depthTexture.image[0]:S.depthTexture.image;(!nt.__webglTexture||ut.width!==S.width||ut.height!==S.height)&&(ut.width=S.width,ut.height=S.height,S.depthTexture.needsUpdate=!0),rt?O(S.depthTexture,0):W(S.depthTexture,0);let gt=nt.__webglTexture,J=me(S),Q=rt?n.TEXTURE_CUBE_MAP_POSITIVE_X+V:n.TEXTURE_2D,dt=S.depthTexture.format===Mi?n.DEPTH_STENCIL_ATTACHMENT:n.DEPTH_ATTACHMENT;if(S.depthTexture.format===pi)yt(S)?a.framebufferTexture2DMultisampleEXT(n.FRAMEBUFFER,dt,Q,gt,0,J):n.framebufferTexture2D(n.FRAMEBUFFER,dt,Q,gt,0);else if(S.depthTexture.format===Mi)yt(S)?a.framebufferTexture2DMultisampleEXT(n.FRAMEBUFFER,dt,Q,gt,0,J):n.framebufferTexture2D(n.FRAMEBUFFER,dt,Q,gt,0);else throw new Error("THREE.WebGLTextures: Unknown depthTexture format.")}function ke(T){let S=i.get(T),V=T.isWebGLCubeRenderTarget===!0;if(S.__boundDepthTexture!==T.depthTexture){let rt=T.depthTexture;if(S.__depthDisposeCallback&&S.__depthDisposeCallback(),rt){let nt=()=>{delete S.__boundDepthTexture,delete S.__depthDisposeCallback,rt.removeEventListener("dispose",nt)};rt.addEventListener("dispose",nt),S.__depthDisposeCallback=nt}S.__boundDepthTexture=rt}if(T.depthTexture&&!S.__autoAllocateDepthBuffer)if(V)for(let rt=0;rt<6;rt++)Qt(S.__webglFramebuffer[rt],T,rt);else T.texture.mipmaps.length>0?Qt(S.__webglFramebuffer[0],T,0):Qt(S.__webglFramebuffer,T,0);else if(V){S.__webglDepthbuffer=[];for(let rt=0;rt<6;rt++)if(e.bindFramebuffer(n.FRAMEBUFFER,S.__webglFramebuffer[rt]),S.__webglDepthbuffer[rt]===void 0)S.__webglDepthbuffer[rt]=n.createRenderbuffer(),le(S.__webglDepthbuffer[rt],T,!1);else{let nt=T.stencilBuffer?n.DEPTH_STENCIL_ATTACHMENT:n.DEPTH_ATTACHMENT,ut=S.__webglDepthbuffer[rt];n.bindRenderbuffer(n.RENDERBUFFER,ut),n.framebufferRenderbuffer(n.FRAMEBUFFER,nt,n.RENDERBUFFER,ut)}}else if(T.texture.mipmaps.length>0?e.bindFramebuffer(n.FRAMEBUFFER,S.__webglFramebuffer[0]):e.bindFramebuffer(n.FRAMEBUFFER,S.__webglFramebuffer),S.__webglDepthbuffer===void 0)S.__webglDepthbuffer=n.createRenderbuffer(),le(S.__webglDepthbuffer,T,!1);else{let nt=T.stencilBuffer?n.DEPTH_STENCIL_ATTACHMENT:n.DEPTH_ATTACHMENT,ut=S.__webglDepthbuffer;n.bindRenderbuffer(n.RENDERBUFFER,ut),n.framebufferRenderbuffer(n.FRAMEBUFFER,nt,n.RENDERBUFFER,ut)}e.bindFramebuffer(n.FRAMEBUFFER,null)}function mn(T,S,V){let rt=i.get(T);S!==void 0&&jt(rt.__webglFramebuffer,T,T.texture,n.COLOR_ATTACHMENT0,n.TEXTURE_2D,0),V!==void 0&&ke(T)}function gn(T){let S=T.texture,V=i.get(T),rt=i.get(S);T.addEventListener("dispose",N),L(T);let nt=T.textures,ut=T.isWebGLCubeRenderTarget===!0,gt=nt.length>1;if(gt||(rt.__webglTexture===void 0&&(rt.__webglTexture=n.createTexture()),rt.__version=S.version,o.memory.textures++),ut){V.__webglFramebuffer=[];for(let J=0;J<6;J++)if(S.mipmaps.length>0){V.__webglFramebuffer[J]=[];for(let Q=0;Q<S.mipmaps.length;Q++)V.__webglFramebuffer[J][Q]=n.createFramebuffer()}else V.__webglFramebuffer[J]=n.createFramebuffer()}else{if(S.mipmaps.length>0){V.__webglFramebuffer=[];for(let J=0;J<S.mipmaps.length;J++)V.__webglFramebuffer[J]=n.createFramebuffer()}else V.__webglFramebuffer=n.createFramebuffer();if(gt)for(let J=0,Q=nt.length;J<Q;J++){let dt=i.get(nt[J]);dt.__webglTexture===void 0&&(dt.__webglTexture=n.createTexture(),o.memory.textures++)}if(T.samples>0&&yt(T)===!1){V.__webglMultisampledFramebuffer=n.createFramebuffer(),V.__webglColorRenderbuffer=[],e.bindFramebuffer(n.FRAMEBUFFER,V.__webglMultisampledFramebuffer);for(let J=0;J<nt.length;J++){let Q=nt[J];V.__webglColorRenderbuffer[J]=n.createRenderbuffer(),n.bindRenderbuffer(n.RENDERBUFFER,V.__webglColorRenderbuffer[J]);let dt=r.convert(Q.format,Q.colorSpace),I=r.convert(Q.type),tt=E(Q.internalFormat,dt,I,Q.normalized,Q.colorSpace,T.isXRRenderTarget===!0),Y=me(T);n.renderbufferStorageMultisample(n.RENDERBUFFER,Y,tt,T.width,T.height),n.framebufferRenderbuffer(n.FRAMEBUFFER,n.COLOR_ATTACHMENT0+J,n.RENDERBUFFER,V.__webglColorRenderbuffer[J])}n.bindRenderbuffer(n.RENDERBUFFER,null),T.depthBuffer&&(V.__webglDepthRenderbuffer=n.createRenderbuffer(),le(V.__webglDepthRenderbuffer,T,!0)),e.bindFramebuffer(n.FRAMEBUFFER,null)}}if(ut){e.bindTexture(n.TEXTURE_CUBE_MAP,rt.__webglTexture),Rt(n.TEXTURE_CUBE_MAP,S);for(let J=0;J<6;J++)if(S.mipmaps.length>0)for(let Q=0;Q<S.mipmaps.length;Q++)jt(V.__webglFramebuffer[J][Q],T,S,n.COLOR_ATTACHMENT0,n.TEXTURE_CUBE_MAP_POSITIVE_X+J,Q);else jt(V.__webglFramebuffer[J],T,S,n.COLOR_ATTACHMENT0,n.TEXTURE_CUBE_MAP_POSITIVE_X+J,0);b(S)?v(n.TEXTURE_CUBE_MAP):S.mipmaps.length>0&&n.texParameteri(n.TEXTURE_CUBE_MAP,n.TEXTURE_MAX_LEVEL,S.mipmaps.length-1),e.unbindTexture()}else if(gt){for(let J=0,Q=nt.length;J<Q;J++){let dt=nt[J],I=i.get(dt),tt=n.TEXTURE_2D;(T.isWebGL3DRenderTarget||T.isWebGLArrayRenderTarget)&&(tt=T.isWebGL3DRenderTarget?n.TEXTURE_3D:n.TEXTURE_2D_ARRAY),e.bindTexture(tt,I.__webglTexture),Rt(tt,dt),jt(V.__webglFramebuffer,T,dt,n.COLOR_ATTACHMENT0+J,tt,0),b(dt)&&v(tt)}e.unbindTexture()}else{let J=n.TEXTURE_2D;if((T.isWebGL3DRenderTarget||T.isWebGLArrayRenderTarget)&&(J=T.isWebGL3DRenderTarget?n.TEXTURE_3D:n.TEXTURE_2D_ARRAY),e.bindTexture(J,rt.__webglTexture),Rt(J,S),S.mipmaps.length>0)for(let Q=0;Q<S.mipmaps.length;Q++)jt(V.__webglFramebuffer[Q],T,S,n.COLOR_ATTACHMENT0,J,Q);else jt(V.__webglFramebuffer,T,S,n.COLOR_ATTACHMENT0,J,0);b(S)?v(J):S.mipmaps.length>0&&n.texParameteri(J,n.TEXTURE_MAX_LEVEL,S.mipmaps.length-1),e.unbindTexture()}T.depthBuffer&&ke(T)}function F(T){let S=T.textures;for(let V=0,rt=S.length;V<rt;V++){let nt=S[V];if(b(nt)&&nt.mipmapsAutoUpdate===!0){let ut=w(T),gt=i.get(nt).__webglTexture;e.bindTexture(ut,gt),v(ut),e.unbindTexture()}}}let _n=[];function pe(T){if(T.samples>0){if(yt(T)===!1){let S=T.textures,V=T.width,rt=T.height,nt=n.COLOR_BUFFER_BIT,ut=T.stencilBuffer?n.DEPTH_STENCIL_ATTACHMENT:n.DEPTH_ATTACHMENT,gt=i.get(T),J=S.length>1;if(J)for(let dt=0;dt<S.length;dt++)e.bindFramebuffer(n.FRAMEBUFFER,gt.__webglMultisampledFramebuffer),n.framebufferRenderbuffer(n.FRAMEBUFFER,n.COLOR_ATTACHMENT0+dt,n.RENDERBUFFER,null),e.bindFramebuffer(n.FRAMEBUFFER,gt.__webglFramebuffer),n.framebufferTexture2D(n.DRAW_FRAMEBUFFER,n.COLOR_ATTACHMENT0+dt,n.TEXTURE_2D,null,0);e.bindFramebuffer(n.READ_FRAMEBUFFER,gt.__webglMultisampledFramebuffer),T.texture.mipmaps.length>0?e.bindFramebuffer(n.DRAW_FRAMEBUFFER,gt.__webglFramebuffer[0]):e.bindFramebuffer(n.DRAW_FRAMEBUFFER,gt.__webglFramebuffer);for(let dt=0;dt<S.length;dt++){if(T.resolveDepthBuffer&&(T.depthBuffer&&(nt|=n.DEPTH_BUFFER_BIT),T.stencilBuffer&&T.resolveStencilBuffer&&(nt|=n.STENCIL_BUFFER_BIT)),J){n.framebufferRenderbuffer(n.READ_FRAMEBUFFER,n.COLOR_ATTACHMENT0,n.RENDERBUFFER,gt.__webglColorRenderbuffer[dt]);let I=i.get(S[dt]).__webglTexture;n.framebufferTexture2D(n.DRAW_FRAMEBUFFER,n.COLOR_ATTACHMENT0,n.TEXTURE_2D,I,0)}n.blitFramebuffer(0,0,V,rt,0,0,V,rt,nt,n.NEAREST),c===!0&&(_n.length=0,_n.push(n.COLOR_ATTACHMENT0+dt),T.depthBuffer&&T.storeMultisampledDepthBuffer===!1&&_n.push(ut),n.invalidateFramebuffer(n.READ_FRAMEBUFFER,_n))}if(e.bindFramebuffer(n.READ_FRAMEBUFFER,null),e.bindFramebuffer(n.DRAW_FRAMEBUFFER,null),J)for(let dt=0;dt<S.length;dt++){e.bindFramebuffer(n.FRAMEBUFFER,gt.__webglMultisampledFramebuffer),n.framebufferRenderbuffer(n.FRAMEBUFFER,n.COLOR_ATTACHMENT0+dt,n.RENDERBUFFER,gt.__webglColorRenderbuffer[dt]);let I=i.get(S[dt]).__webglTexture;e.bindFramebuffer(n.FRAMEBUFFER,gt.__webglFramebuffer),n.framebufferTexture2D(n.DRAW_FRAMEBUFFER,n.COLOR_ATTACHMENT0+dt,n.TEXTURE_2D,I,0)}e.bindFramebuffer(n.DRAW_FRAMEBUFFER,gt.__webglMultisampledFramebuffer)}else if(T.depthBuffer&&T.storeMultisampledDepthBuffer===!1&&c){let S=T.stencilBuffer?n.DEPTH_STENCIL_ATTACHMENT:n.DEPTH_ATTACHMENT;n.invalidateFramebuffer(n.DRAW_FRAMEBUFFER,[S])}}}function me(T){return Math.min(s.maxSamples,T.samples)}function yt(T){let S=i.get(T);return T.samples>0&&t.has("WEBGL_multisampled_render_to_texture")===!0&&S.__useRenderToTexture!==!1}function Me(T){let S=o.render.frame;h.get(T)!==S&&(h.set(T,S),T.update())}function Ut(T,S){let V=T.colorSpace,rt=T.format,nt=T.type;return T.isCompressedTexture===!0||T.isVideoTexture===!0||V!==yo&&V!==Si&&(Jt.getTransfer(V)===se?(rt!==Gn||nt!==rn)&&Nt("WebGLTextures: sRGB encoded textures have to use RGBAFormat and UnsignedByteType."):Ot("WebGLTextures: Unsupported texture color space:",V)),S}function kt(T){return typeof HTMLImageElement<"u"&&T instanceof HTMLImageElement?(l.width=T.naturalWidth||T.width,l.height=T.naturalHeight||T.height):typeof VideoFrame<"u"&&T instanceof VideoFrame?(l.width=T.displayWidth,l.height=T.displayHeight):(l.width=T.width,l.height=T.height),l}this.allocateTextureUnit=Dt,this.resetTextureUnits=Z,this.getTextureUnits=it,this.setTextureUnits=Mt,this.setTexture2D=W,this.setTexture2DArray=et,this.setTexture3D=ot,this.setTextureCube=O,this.rebindTextures=mn,this.setupRenderTarget=gn,this.updateRenderTargetMipmap=F,this.updateMultisampleRenderTarget=pe,this.setupDepthRenderbuffer=ke,this.setupFrameBufferTexture=jt,this.useMultisampledRTT=yt,this.dispose=z}function LA(n,t){function e(i,s=Si){let r,o=Jt.getTransfer(s);if(i===rn)return n.UNSIGNED_BYTE;if(i===vc)return n.UNSIGNED_SHORT_4_4_4_4;if(i===bc)return n.UNSIGNED_SHORT_5_5_5_1;if(i===kf)return n.UNSIGNED_INT_5_9_9_9_REV;if(i===zf)return n.UNSIGNED_INT_10F_11F_11F_REV;if(i===Ff)return n.BYTE;if(i===Bf)return n.SHORT;if(i===Fr)return n.UNSIGNED_SHORT;if(i===yc)return n.INT;if(i===kn)return n.UNSIGNED_INT;if(i===zn)return n.FLOAT;if(i===Vn)return n.HALF_FLOAT;if(i===Vf)return n.ALPHA;if(i===Gf)return n.RGB;if(i===Gn)return n.RGBA;if(i===pi)return n.DEPTH_COMPONENT;if(i===Mi)return n.DEPTH_STENCIL;if(i===Hf)return n.RED;if(i===Mc)return n.RED_INTEGER;if(i===Ji)return n.RG;if(i===Sc)return n.RG_INTEGER;if(i===wc)return n.RGBA_INTEGER;if(i===ta||i===ea||i===na||i===ia)if(o===se)if(r=t.get("WEBGL_compressed_texture_s3tc_srgb"),r!==null){if(i===ta)return r.COMPRESSED_SRGB_S3TC_DXT1_EXT;if(i===ea)return r.COMPRESSED_SRGB_ALPHA_S3TC_DXT1_EXT;if(i===na)return r.COMPRESSED_SRGB_ALPHA_S3TC_DXT3_EXT;if(i===ia)return r.COMPRESSED_SRGB_ALPHA_S3TC_DXT5_EXT}else return null;else if(r=t.get("WEBGL_compressed_texture_s3tc"),r!==null){if(i===ta)return r.COMPRESSED_RGB_S3TC_DXT1_EXT;if(i===ea)return r.COMPRESSED_RGBA_S3TC_DXT1_EXT;if(i===na)return r.COMPRESSED_RGBA_S3TC_DXT3_EXT;if(i===ia)return r.COMPRESSED_RGBA_S3TC_DXT5_EXT}else return null;if(i===Ac||i===Ec||i===Tc||i===Cc)if(r=t.get("WEBGL_compressed_texture_pvrtc"),r!==null){if(i===Ac)return r.COMPRESSED_RGB_PVRTC_4BPPV1_IMG;if(i===Ec)return r.COMPRESSED_RGB_PVRTC_2BPPV1_IMG;if(i===Tc)return r.COMPRESSED_RGBA_PVRTC_4BPPV1_IMG;if(i===Cc)return r.COMPRESSED_RGBA_PVRTC_2BPPV1_IMG}else return null;if(i===Rc||i===Pc||i===Ic||i===Lc||i===Nc||i===sa||i===Dc)if(r=t.get("WEBGL_compressed_texture_etc"),r!==null){if(i===Rc||i===Pc)return o===se?r.COMPRESSED_SRGB8_ETC2:r.COMPRESSED_RGB8_ETC2;if(i===Ic)return o===se?r.COMPRESSED_SRGB8_ALPHA8_ETC2_EAC:r.COMPRESSED_RGBA8_ETC2_EAC;if(i===Lc)return r.COMPRESSED_R11_EAC;if(i===Nc)return r.COMPRESSED_SIGNED_R11_EAC;if(i===sa)return r.COMPRESSED_RG11_EAC;if(i===Dc)return r.COMPRESSED_SIGNED_RG11_EAC}else return null;if(i===Uc||i===Oc||i===Fc||i===Bc||i===kc||i===zc||i===Vc||i===Gc||i===Hc||i===Wc||i===Xc||i===$c||i===qc||i===Yc)if(r=t.get("WEBGL_compressed_texture_astc"),r!==null){if(i===Uc)return o===se?r.COMPRESSED_SRGB8_ALPHA8_ASTC_4x4_KHR:r.COMPRESSED_RGBA_ASTC_4x4_KHR;if(i===Oc)return o===se?r.COMPRESSED_SRGB8_ALPHA8_ASTC_5x4_KHR:r.COMPRESSED_RGBA_ASTC_5x4_KHR;if(i===Fc)return o===se?r.COMPRESSED_SRGB8_ALPHA8_ASTC_5x5_KHR:r.COMPRESSED_RGBA_ASTC_5x5_KHR;if(i===Bc)return o===se?r.COMPRESSED_SRGB8_ALPHA8_ASTC_6x5_KHR:r.COMPRESSED_RGBA_ASTC_6x5_KHR;if(i===kc)return o===se?r.COMPRESSED_SRGB8_ALPHA8_ASTC_6x6_KHR:r.COMPRESSED_RGBA_ASTC_6x6_KHR;if(i===zc)return o===se?r.COMPRESSED_SRGB8_ALPHA8_ASTC_8x5_KHR:r.COMPRESSED_RGBA_ASTC_8x5_KHR;if(i===Vc)return o===se?r.COMPRESSED_SRGB8_ALPHA8_ASTC_8x6_KHR:r.COMPRESSED_RGBA_ASTC_8x6_KHR;if(i===Gc)return o===se?r.COMPRESSED_SRGB8_ALPHA8_ASTC_8x8_KHR:r.COMPRESSED_RGBA_ASTC_8x8_KHR;if(i===Hc)return o===se?r.COMPRESSED_SRGB8_ALPHA8_ASTC_10x5_KHR:r.COMPRESSED_RGBA_ASTC_10x5_KHR;if(i===Wc)return o===se?r.COMPRESSED_SRGB8_ALPHA8_ASTC_10x6_KHR:r.COMPRESSED_RGBA_ASTC_10x6_KHR;if(i===Xc)return o===se?r.COMPRESSED_SRGB8_ALPHA8_ASTC_10x8_KHR:r.COMPRESSED_RGBA_ASTC_10x8_KHR;if(i===$c)return o===se?r.COMPRESSED_SRGB8_ALPHA8_ASTC_10x10_KHR:r.COMPRESSED_RGBA_ASTC_10x10_KHR;if(i===qc)return o===se?r.COMPRESSED_SRGB8_ALPHA8_ASTC_12x10_KHR:r.COMPRESSED_RGBA_ASTC_12x10_KHR;if(i===Yc)return o===se?r.COMPRESSED_SRGB8_ALPHA8_ASTC_12x12_KHR:r.COMPRESSED_RGBA_ASTC_12x12_KHR}else return null;if(i===Zc||i===Jc||i===jc)if(r=t.get("EXT_texture_compression_bptc"),r!==null){if(i===Zc)return o===se?r.COMPRESSED_SRGB_ALPHA_BPTC_UNORM_EXT:r.COMPRESSED_RGBA_BPTC_UNORM_EXT;if(i===Jc)return r.COMPRESSED_RGB_BPTC_SIGNED_FLOAT_EXT;if(i===jc)return r.COMPRESSED_RGB_BPTC_UNSIGNED_FLOAT_EXT}else return null;if(i===Kc||i===Qc||i===ra||i===th)if(r=t.get("EXT_texture_compression_rgtc"),r!==null){if(i===Kc)return r.COMPRESSED_RED_RGTC1_EXT;if(i===Qc)return r.COMPRESSED_SIGNED_RED_RGTC1_EXT;if(i===ra)return r.COMPRESSED_RED_GREEN_RGTC2_EXT;if(i===th)return r.COMPRESSED_SIGNED_RED_GREEN_RGTC2_EXT}else return null;return i===Ns?n.UNSIGNED_INT_24_8:n[i]!==void 0?n[i]:null}return{convert:e}}var NA=`
void main() {

	gl_Position = vec4( position, 1.0 );

}`,DA=`
uniform sampler2DArray depthColor;
uniform float depthWidth;
uniform float depthHeight;

void main() {

	vec2 coord = vec2( gl_FragCoord.x / depthWidth, gl_FragCoord.y / depthHeight );

	if ( coord.x >= 1.0 ) {

		gl_FragDepth = texture( depthColor, vec3( coord.x - 1.0, coord.y, 1 ) ).r;

	} else {

		gl_FragDepth = texture( depthColor, vec3( coord.x, coord.y, 0 ) ).r;

	}

}`,fd=class{constructor(){this.texture=null,this.mesh=null,this.depthNear=0,this.depthFar=0}init(t,e){if(this.texture===null){let i=new Po(t.texture);(t.depthNear!==e.depthNear||t.depthFar!==e.depthFar)&&(this.depthNear=t.depthNear,this.depthFar=t.depthFar),this.texture=i}}getMesh(t){if(this.texture!==null&&this.mesh===null){let e=t.cameras[0].viewport,i=new En({vertexShader:NA,fragmentShader:DA,uniforms:{depthColor:{value:this.texture},depthWidth:{value:e.z},depthHeight:{value:e.w}}});this.mesh=new de(new Ts(20,20),i)}return this.mesh}reset(){this.texture=null,this.mesh=null}getDepthTexture(){return this.texture}},dd=class extends Fn{constructor(t,e){super();let i=this,s=null,r=1,o=null,a="local-floor",c=1,l=null,h=null,u=null,f=null,d=null,m=null,_=typeof XRWebGLBinding<"u",p=new fd,g={},x=e.getContextAttributes(),b=null,v=null,w=[],E=[],y=new ht,M=null,L=null,R=new je;R.viewport=new oe;let D=new je;D.viewport=new oe;let N=[R,D],B=new pc,C=null,z=null;this.cameraAutoUpdate=!0,this.enabled=!1,this.isPresenting=!1,this.getController=function(j){let W=w[j];return W===void 0&&(W=new Ar,w[j]=W),W.getTargetRaySpace()},this.getControllerGrip=function(j){let W=w[j];return W===void 0&&(W=new Ar,w[j]=W),W.getGripSpace()},this.getHand=function(j){let W=w[j];return W===void 0&&(W=new Ar,w[j]=W),W.getHandSpace()};function $(j){let W=E.indexOf(j.inputSource);if(W===-1)return;let et=w[W];et!==void 0&&(et.update(j.inputSource,j.frame,l||o),et.dispatchEvent({type:j.type,data:j.inputSource}))}function G(){s.removeEventListener("select",$),s.removeEventListener("selectstart",$),s.removeEventListener("selectend",$),s.removeEventListener("squeeze",$),s.removeEventListener("squeezestart",$),s.removeEventListener("squeezeend",$),s.removeEventListener("end",G),s.removeEventListener("inputsourceschange",st);for(let j=0;j<w.length;j++){let W=E[j];W!==null&&(E[j]=null,w[j].disconnect(W))}C=null,z=null,p.reset();for(let j in g)delete g[j];if(t.setRenderTarget(b),d=null,f=null,u=null,s=null,v=null,Dt.stop(),i.isPresenting=!1,t.setPixelRatio(M),t.setSize(y.width,y.height,!1),L!==null){let j=L.camera;j.fov=L.fov,j.zoom=L.zoom,j.updateProjectionMatrix(),L=null}i.dispatchEvent({type:"sessionend"})}this.setFramebufferScaleFactor=function(j){r=j,i.isPresenting===!0&&Nt("WebXRManager: Cannot change framebuffer scale while presenting.")},this.setReferenceSpaceType=function(j){a=j,i.isPresenting===!0&&Nt("WebXRManager: Cannot change reference space type while presenting.")},this.getReferenceSpace=function(){return l||o},this.setReferenceSpace=function(j){l=j},this.getBaseLayer=function(){return f!==null?f:d},this.getBinding=function(){return u===null&&_&&(u=new XRWebGLBinding(s,e)),u},this.getFrame=function(){return m},this.getSession=function(){return s},this.setSession=async function(j){if(s=j,s!==null){if(b=t.getRenderTarget(),s.addEventListener("select",$),s.addEventListener("selectstart",$),s.addEventListener("selectend",$),s.addEventListener("squeeze",$),s.addEventListener("squeezestart",$),s.addEventListener("squeezeend",$),s.addEventListener("end",G),s.addEventListener("inputsourceschange",st),x.xrCompatible!==!0&&await e.makeXRCompatible(),M=t.getPixelRatio(),t.getSize(y),_&&"createProjectionLayer"in XRWebGLBinding.prototype){let et=null,ot=null,O=null;x.depth&&(O=x.stencil?e.DEPTH24_STENCIL8:e.DEPTH_COMPONENT24,et=x.stencil?Mi:pi,ot=x.stencil?Ns:kn);let K={colorFormat:e.RGBA8,depthFormat:O,scaleFactor:r};u=this.getBinding(),f=u.createProjectionLayer(K),s.updateRenderState({layers:[f]}),t.setPixelRatio(1),t.setSize(f.textureWidth,f.textureHeight,!1),v=new hn(f.textureWidth,f.textureHeight,{format:Gn,type:rn,depthTexture:new xi(f.textureWidth,f.textureHeight,ot,void 0,void 0,void 0,void 0,void 0,void 0,et),stencilBuffer:x.stencil,colorSpace:t.outputColorSpace,samples:x.antialias?4:0,resolveDepthBuffer:f.ignoreDepthValues===!1,resolveStencilBuffer:f.ignoreDepthValues===!1,storeMultisampledDepthBuffer:f.ignoreDepthValues===!1,storeMultisampledStencilBuffer:f.ignoreDepthValues===!1})}else{let et={antialias:x.antialias,alpha:!0,depth:x.depth,stencil:x.stencil,framebufferScaleFactor:r};d=new XRWebGLLayer(s,e,et),s.updateRenderState({baseLayer:d}),t.setPixelRatio(1),t.setSize(d.framebufferWidth,d.framebufferHeight,!1),v=new hn(d.framebufferWidth,d.framebufferHeight,{format:Gn,type:rn,colorSpace:t.outputColorSpace,stencilBuffer:x.stencil,resolveDepthBuffer:d.ignoreDepthValues===!1,resolveStencilBuffer:d.ignoreDepthValues===!1,storeMultisampledDepthBuffer:d.ignoreDepthValues===!1,storeMultisampledStencilBuffer:d.ignoreDepthValues===!1})}v.isXRRenderTarget=!0,this.setFoveation(c),l=null,o=await s.requestReferenceSpace(a),Dt.setContext(s),Dt.start(),i.isPresenting=!0,i.dispatchEvent({type:"sessionstart"})}},this.getEnvironmentBlendMode=function(){if(s!==null)return s.environmentBlendMode},this.getDepthTexture=function(){return p.getDepthTexture()};function st(j){for(let W=0;W<j.removed.length;W++){let et=j.removed[W],ot=E.indexOf(et);ot>=0&&(E[ot]=null,w[ot].disconnect(et))}for(let W=0;W<j.added.length;W++){let et=j.added[W],ot=E.indexOf(et);if(ot===-1){for(let K=0;K<w.length;K++)if(K>=E.length){E.push(et),ot=K;break}else if(E[K]===null){E[K]=et,ot=K;break}if(ot===-1)break}let O=w[ot];O&&O.connect(et)}}function X(j,W){W===null?j.matrixWorld.copy(j.matrix):j.matrixWorld.multiplyMatrices(W.matrixWorld,j.matrix),j.matrixWorldInverse.copy(j.matrixWorld).invert()}this.updateCamera=function(j){if(s===null)return;let W=j.near,et=j.far;p.texture!==null&&(p.depthNear>0&&(W=p.depthNear),p.depthFar>0&&(et=p.depthFar)),B.near=D.near=R.near=W,B.far=D.far=R.far=et,(C!==B.near||z!==B.far)&&(s.updateRenderState({depthNear:B.near,depthFar:B.far}),C=B.near,z=B.far),B.layers.mask=j.layers.mask|6,R.layers.mask=B.layers.mask&-5,D.layers.mask=B.layers.mask&-3;let ot=j.parent,O=B.cameras;X(B,ot);for(let K=0;K<O.length;K++)X(O[K],ot);B.projectionMatrix.copy(R.projectionMatrix),B.projectionMatrixInverse.copy(R.projectionMatrixInverse),L===null&&j.isPerspectiveCamera&&(L={camera:j,fov:j.fov,zoom:j.zoom}),Z(j,B,ot)};function Z(j,W,et){et===null?j.matrix.copy(W.matrixWorld):(j.matrix.copy(et.matrixWorld),j.matrix.invert(),j.matrix.multiply(W.matrixWorld)),j.matrix.decompose(j.position,j.quaternion,j.scale),j.updateMatrixWorld(!0),j.projectionMatrix.copy(W.projectionMatrix),j.projectionMatrixInverse.copy(W.projectionMatrixInverse),j.isPerspectiveCamera&&(j.fov=Mr*2*Math.atan(1/j.projectionMatrix.elements[5]),j.zoom=1)}this.getCamera=function(){return B},this.getFoveation=function(){if(!(f===null&&d===null))return c},this.setFoveation=function(j){c=j,f!==null&&(f.fixedFoveation=j),d!==null&&d.fixedFoveation!==void 0&&(d.fixedFoveation=j)},this.hasDepthSensing=function(){return p.texture!==null},this.getDepthSensingMesh=function(){return p.getMesh(B)},this.getCameraTexture=function(j){return g[j]};let it=null;function Mt(j,W){if(h=W.getViewerPose(l||o),m=W,h!==null){let et=h.views;d!==null&&(t.setRenderTargetFramebuffer(v,d.framebuffer),t.setRenderTarget(v));let ot=!1;et.length!==B.cameras.length&&(B.cameras.length=0,ot=!0);for(let ct=0;ct<et.length;ct++){let Rt=et[ct],St=null;if(d!==null)St=d.getViewport(Rt);else{let qt=u.getViewSubImage(f,Rt);St=qt.viewport,ct===0&&(t.setRenderTargetTextures(v,qt.colorTexture,qt.depthStencilTexture),t.setRenderTarget(v))}let Pt=N[ct];Pt===void 0&&(Pt=new je,Pt.layers.enable(ct),Pt.viewport=new oe,N[ct]=Pt),Pt.matrix.fromArray(Rt.transform.matrix),Pt.matrix.decompose(Pt.position,Pt.quaternion,Pt.scale),Pt.projectionMatrix.fromArray(Rt.projectionMatrix),Pt.projectionMatrixInverse.copy(Pt.projectionMatrix).invert(),Pt.viewport.set(St.x,St.y,St.width,St.height),ct===0&&(B.matrix.copy(Pt.matrix),B.matrix.decompose(B.position,B.quaternion,B.scale)),ot===!0&&B.cameras.push(Pt)}let O=s.enabledFeatures;if(O&&O.includes("depth-sensing")&&s.depthUsage=="gpu-optimized"&&_){u=i.getBinding();let ct=u.getDepthInformation(et[0]);ct&&ct.isValid&&ct.texture&&p.init(ct,s.renderState)}if(O&&O.includes("camera-access")&&_){t.state.unbindTexture(),u=i.getBinding();for(let ct=0;ct<et.length;ct++){let Rt=et[ct].camera;if(Rt){let St=g[Rt];St||(St=new Po,g[Rt]=St);let Pt=u.getCameraImage(Rt);St.sourceTexture=Pt}}}}for(let et=0;et<w.length;et++){let ot=E[et],O=w[et];ot!==null&&O!==void 0&&O.update(ot,W,l||o)}it&&it(j,W),W.detectedPlanes&&i.dispatchEvent({type:"planesdetected",data:W}),m=null}let Dt=new l_;Dt.setAnimationLoop(Mt),this.setAnimationLoop=function(j){it=j},this.dispose=function(){}}},UA=new re,x_=new Bt;x_.set(-1,0,0,0,1,0,0,0,1);function OA(n,t){function e(p,g){p.matrixAutoUpdate===!0&&p.updateMatrix(),g.value.copy(p.matrix)}function i(p,g){g.color.getRGB(p.fogColor.value,td(n)),g.isFog?(p.fogNear.value=g.near,p.fogFar.value=g.far):g.isFogExp2&&(p.fogDensity.value=g.density)}function s(p,g,x,b,v){g.isNodeMaterial?g.uniformsNeedUpdate=!1:g.isMeshBasicMaterial?r(p,g):g.isMeshLambertMaterial?(r(p,g),g.envMap&&(p.envMapIntensity.value=g.envMapIntensity)):g.isMeshToonMaterial?(r(p,g),u(p,g)):g.isMeshPhongMaterial?(r(p,g),h(p,g),g.envMap&&(p.envMapIntensity.value=g.envMapIntensity)):g.isMeshStandardMaterial?(r(p,g),f(p,g),g.isMeshPhysicalMaterial&&d(p,g,v)):g.isMeshMatcapMaterial?(r(p,g),m(p,g)):g.isMeshDepthMaterial?r(p,g):g.isMeshDistanceMaterial?(r(p,g),_(p,g)):g.isMeshNormalMaterial?r(p,g):g.isLineBasicMaterial?(o(p,g),g.isLineDashedMaterial&&a(p,g)):g.isPointsMaterial?c(p,g,x,b):g.isSpriteMaterial?l(p,g):g.isShadowMaterial?(p.color.value.copy(g.color),p.opacity.value=g.opacity):g.isShaderMaterial&&(g.uniformsNeedUpdate=!1)}function r(p,g){p.opacity.value=g.opacity,g.color&&p.diffuse.value.copy(g.color),g.emissive&&p.emissive.value.copy(g.emissive).multiplyScalar(g.emissiveIntensity),g.map&&(p.map.value=g.map,e(g.map,p.mapTransform)),g.alphaMap&&(p.alphaMap.value=g.alphaMap,e(g.alphaMap,p.alphaMapTransform)),g.bumpMap&&(p.bumpMap.value=g.bumpMap,e(g.bumpMap,p.bumpMapTransform),p.bumpScale.value=g.bumpScale,g.side===Ue&&(p.bumpScale.value*=-1)),g.normalMap&&(p.normalMap.value=g.normalMap,e(g.normalMap,p.normalMapTransform),p.normalScale.value.copy(g.normalScale),g.side===Ue&&p.normalScale.value.negate()),g.displacementMap&&(p.displacementMap.value=g.displacementMap,e(g.displacementMap,p.displacementMapTransform),p.displacementScale.value=g.displacementScale,p.displacementBias.value=g.displacementBias),g.emissiveMap&&(p.emissiveMap.value=g.emissiveMap,e(g.emissiveMap,p.emissiveMapTransform)),g.specularMap&&(p.specularMap.value=g.specularMap,e(g.specularMap,p.specularMapTransform)),g.alphaTest>0&&(p.alphaTest.value=g.alphaTest);let x=t.get(g),b=x.envMap,v=x.envMapRotation;b&&(p.envMap.value=b,p.envMapRotation.value.setFromMatrix4(UA.makeRotationFromEuler(v)).transpose(),b.isCubeTexture&&b.isRenderTargetTexture===!1&&p.envMapRotation.value.premultiply(x_),p.reflectivity.value=g.reflectivity,p.ior.value=g.ior,p.refractionRatio.value=g.refractionRatio),g.lightMap&&(p.lightMap.value=g.lightMap,p.lightMapIntensity.value=g.lightMapIntensity,e(g.lightMap,p.lightMapTransform)),g.aoMap&&(p.aoMap.value=g.aoMap,p.aoMapIntensity.value=g.aoMapIntensity,e(g.aoMap,p.aoMapTransform))}function o(p,g){p.diffuse.value.copy(g.color),p.opacity.value=g.opacity,g.map&&(p.map.value=g.map,e(g.map,p.mapTransform))}function a(p,g){p.dashSize.value=g.dashSize,p.totalSize.value=g.dashSize+g.gapSize,p.scale.value=g.scale}function c(p,g,x,b){p.diffuse.value.copy(g.color),p.opacity.value=g.opacity,p.size.value=g.size*x,p.scale.value=b*.5,g.map&&(p.map.value=g.map,e(g.map,p.uvTransform)),g.alphaMap&&(p.alphaMap.value=g.alphaMap,e(g.alphaMap,p.alphaMapTransform)),g.alphaTest>0&&(p.alphaTest.value=g.alphaTest)}function l(p,g){p.diffuse.value.copy(g.color),p.opacity.value=g.opacity,p.rotation.value=g.rotation,g.map&&(p.map.value=g.map,e(g.map,p.mapTransform)),g.alphaMap&&(p.alphaMap.value=g.alphaMap,e(g.alphaMap,p.alphaMapTransform)),g.alphaTest>0&&(p.alphaTest.value=g.alphaTest)}function h(p,g){p.specular.value.copy(g.specular),p.shininess.value=Math.max(g.shininess,1e-4)}function u(p,g){g.gradientMap&&(p.gradientMap.value=g.gradientMap)}function f(p,g){p.metalness.value=g.metalness,g.metalnessMap&&(p.metalnessMap.value=g.metalnessMap,e(g.metalnessMap,p.metalnessMapTransform)),p.roughness.value=g.roughness,g.roughnessMap&&(p.roughnessMap.value=g.roughnessMap,e(g.roughnessMap,p.roughnessMapTransform)),g.envMap&&(p.envMapIntensity.value=g.envMapIntensity)}function d(p,g,x){p.ior.value=g.ior,g.diffuseRoughness>0&&(p.diffuseRoughness.value=g.diffuseRoughness,g.diffuseRoughnessMap&&(p.diffuseRoughnessMap.value=g.diffuseRoughnessMap,e(g.diffuseRoughnessMap,p.diffuseRoughnessMapTransform))),g.sheen>0&&(p.sheenColor.value.copy(g.sheenColor).multiplyScalar(g.sheen),p.sheenRoughness.value=g.sheenRoughness,g.sheenColorMap&&(p.sheenColorMap.value=g.sheenColorMap,e(g.sheenColorMap,p.sheenColorMapTransform)),g.sheenRoughnessMap&&(p.sheenRoughnessMap.value=g.sheenRoughnessMap,e(g.sheenRoughnessMap,p.sheenRoughnessMapTransform))),g.clearcoat>0&&(p.clearcoat.value=g.clearcoat,p.clearcoatRoughness.value=g.clearcoatRoughness,g.clearcoatMap&&(p.clearcoatMap.value=g.clearcoatMap,e(g.clearcoatMap,p.clearcoatMapTransform)),g.clearcoatRoughnessMap&&(p.clearcoatRoughnessMap.value=g.clearcoatRoughnessMap,e(g.clearcoatRoughnessMap,p.clearcoatRoughnessMapTransform)),g.clearcoatNormalMap&&(p.clearcoatNormalMap.value=g.clearcoatNormalMap,e(g.clearcoatNormalMap,p.clearcoatNormalMapTransform),p.clearcoatNormalScale.value.copy(g.clearcoatNormalScale),g.side===Ue&&p.clearcoatNormalScale.value.negate())),g.dispersion>0&&(p.dispersion.value=g.dispersion),g.retroreflectivity>0&&(p.retroreflectivity.value=g.retroreflectivity),g.iridescence>0&&(p.iridescence.value=g.iridescence,p.iridescenceIOR.value=g.iridescenceIOR,p.iridescenceThicknessMinimum.value=g.iridescenceThicknessMinimum,p.iridescenceThicknessMaximum.value=g.iridescenceThicknessMaximum,g.iridescenceMap&&(p.iridescenceMap.value=g.iridescenceMap,e(g.iridescenceMap,p.iridescenceMapTransform)),g.iridescenceThicknessMap&&(p.iridescenceThicknessMap.value=g.iridescenceThicknessMap,e(g.iridescenceThicknessMap,p.iridescenceThicknessMapTransform))),g.transmission>0&&(p.transmission.value=g.transmission,p.transmissionSamplerMap.value=x.texture,p.transmissionSamplerSize.value.set(x.width,x.height),g.transmissionMap&&(p.transmissionMap.value=g.transmissionMap,e(g.transmissionMap,p.transmissionMapTransform)),p.thickness.value=g.thickness,g.thicknessMap&&(p.thicknessMap.value=g.thicknessMap,e(g.thicknessMap,p.thicknessMapTransform)),p.attenuationDistance.value=g.attenuationDistance,p.attenuationColor.value.copy(g.attenuationColor)),g.anisotropy>0&&(p.anisotropyVector.value.set(g.anisotropy*Math.cos(g.anisotropyRotation),g.anisotropy*Math.sin(g.anisotropyRotation)),g.anisotropyMap&&(p.anisotropyMap.value=g.anisotropyMap,e(g.anisotropyMap,p.anisotropyMapTransform))),p.specularIntensity.value=g.specularIntensity,p.specularColor.value.copy(g.specularColor),g.specularColorMap&&(p.specularColorMap.value=g.specularColorMap,e(g.specularColorMap,p.specularColorMapTransform)),g.specularIntensityMap&&(p.specularIntensityMap.value=g.specularIntensityMap,e(g.specularIntensityMap,p.specularIntensityMapTransform))}function m(p,g){g.matcap&&(p.matcap.value=g.matcap)}function _(p,g){let x=t.get(g).light;p.referencePosition.value.setFromMatrixPosition(x.matrixWorld),p.nearDistance.value=x.shadow.camera.near,p.farDistance.value=x.shadow.camera.far}return{refreshFogUniforms:i,refreshMaterialUniforms:s}}function FA(n,t,e,i){let s={},r={};function o(x,b){let v=b.program;i.uniformBlockBinding(x,v,s[x.id])}function a(x,b){let v=s[x.id];v===void 0&&(m(x),v=c(x),s[x.id]=v,x.addEventListener("dispose",p));let w=b.program;i.updateUBOMapping(x,w);let E=t.render.frame;r[x.id]!==E&&(l(x),r[x.id]=E)}function c(x){let b=n.createBuffer(),v=x.__size,w=x.usage;return n.bindBuffer(n.UNIFORM_BUFFER,b),n.bufferData(n.UNIFORM_BUFFER,v,w),n.bindBuffer(n.UNIFORM_BUFFER,null),b}function l(x){let b=s[x.id],v=x.uniforms,w=x.__cache;n.bindBuffer(n.UNIFORM_BUFFER,b);for(let E=0,y=v.length;E<y;E++){let M=v[E];if(Array.isArray(M))for(let L=0,R=M.length;L<R;L++)h(M[L],E,L,w);else h(M,E,0,w)}n.bindBuffer(n.UNIFORM_BUFFER,null)}function h(x,b,v,w){if(f(x,b,v,w)===!0){let E=x.__offset,y=x.value;if(Array.isArray(y)){let M=0;for(let L=0;L<y.length;L++){let R=y[L],D=_(R,!0);u(R,x.__data,M),M+=D.storage/Float32Array.BYTES_PER_ELEMENT}}else u(y,x.__data,0);n.bufferSubData(n.UNIFORM_BUFFER,E,x.__data)}}function u(x,b,v){typeof x=="number"||typeof x=="boolean"?b[v]=x:x.isMatrix3?(b[v]=x.elements[0],b[v+1]=x.elements[1],b[v+2]=x.elements[2],b[v+3]=0,b[v+4]=x.elements[3],b[v+5]=x.elements[4],b[v+6]=x.elements[5],b[v+7]=0,b[v+8]=x.elements[6],b[v+9]=x.elements[7],b[v+10]=x.elements[8],b[v+11]=0):ArrayBuffer.isView(x)?b.set(x.subarray(0,b.length-v),v):x.toArray(b,v)}function f(x,b,v,w){let E=x.value,y=b+"_"+v;if(Array.isArray(E)){w[y]===void 0&&(w[y]=[]);let M=w[y],L=!1;for(let R=0;R<E.length;R++)d(E[R],M,R)===!0&&(L=!0);return L}return d(E,w,y)}function d(x,b,v){if(b[v]===void 0)return typeof x=="number"||typeof x=="boolean"?b[v]=x:ArrayBuffer.isView(x)?b[v]=x.slice():b[v]=x.clone(),!0;{let w=b[v];if(typeof x=="number"||typeof x=="boolean"){if(w!==x)return b[v]=x,!0}else{if(ArrayBuffer.isView(x))return!0;if(w.equals(x)===!1)return w.copy(x),!0}}return!1}function m(x){let b=x.uniforms,v=0,w=16;for(let y=0,M=b.length;y<M;y++){let L=Array.isArray(b[y])?b[y]:[b[y]];for(let R=0,D=L.length;R<D;R++){let N=L[R],B=Array.isArray(N.value)?N.value:[N.value],C=Array.isArray(b[y])||Array.isArray(N.value),z=v;for(let G=0,st=B.length;G<st;G++){let X=B[G],Z=_(X,C),it=v%w,Mt=it%Z.boundary,Dt=it+Mt;v+=Mt,Dt!==0&&w-Dt<Z.storage&&(v+=w-Dt),G===0&&(z=v),v+=Z.storage}let $=N.type==="int"?Int32Array:N.type==="uint"?Uint32Array:Float32Array;N.__data=new $((v-z)/Float32Array.BYTES_PER_ELEMENT),N.__offset=z}}let E=v%w;return E>0&&(v+=w-E),x.__size=v,x.__cache={},this}function _(x,b){let v={boundary:0,storage:0};return typeof x=="number"||typeof x=="boolean"?(v.boundary=4,v.storage=4):x.isVector2?(v.boundary=8,v.storage=8):x.isVector3||x.isColor?(v.boundary=16,v.storage=12):x.isVector4?(v.boundary=16,v.storage=16):x.isMatrix3?(v.boundary=16,v.storage=48):x.isMatrix4?(v.boundary=16,v.storage=64):x.isTexture?Nt("WebGLRenderer: Texture samplers can not be part of an uniforms group."):ArrayBuffer.isView(x)?(v.boundary=16,v.storage=x.byteLength):Nt("WebGLRenderer: Unsupported uniform value type.",x),b===!0&&(v.boundary=16,v.storage=Math.ceil(v.storage/16)*16),v}function p(x){let b=x.target;b.removeEventListener("dispose",p),n.deleteBuffer(s[b.id]),delete s[b.id],delete r[b.id]}function g(){for(let x in s)n.deleteBuffer(s[x]);s={},r={}}return{bind:o,update:a,dispose:g}}var BA=new Uint16Array([12469,15057,12620,14925,13266,14620,13807,14376,14323,13990,14545,13625,14713,13328,14840,12882,14931,12528,14996,12233,15039,11829,15066,11525,15080,11295,15085,10976,15082,10705,15073,10495,13880,14564,13898,14542,13977,14430,14158,14124,14393,13732,14556,13410,14702,12996,14814,12596,14891,12291,14937,11834,14957,11489,14958,11194,14943,10803,14921,10506,14893,10278,14858,9960,14484,14039,14487,14025,14499,13941,14524,13740,14574,13468,14654,13106,14743,12678,14818,12344,14867,11893,14889,11509,14893,11180,14881,10751,14852,10428,14812,10128,14765,9754,14712,9466,14764,13480,14764,13475,14766,13440,14766,13347,14769,13070,14786,12713,14816,12387,14844,11957,14860,11549,14868,11215,14855,10751,14825,10403,14782,10044,14729,9651,14666,9352,14599,9029,14967,12835,14966,12831,14963,12804,14954,12723,14936,12564,14917,12347,14900,11958,14886,11569,14878,11247,14859,10765,14828,10401,14784,10011,14727,9600,14660,9289,14586,8893,14508,8533,15111,12234,15110,12234,15104,12216,15092,12156,15067,12010,15028,11776,14981,11500,14942,11205,14902,10752,14861,10393,14812,9991,14752,9570,14682,9252,14603,8808,14519,8445,14431,8145,15209,11449,15208,11451,15202,11451,15190,11438,15163,11384,15117,11274,15055,10979,14994,10648,14932,10343,14871,9936,14803,9532,14729,9218,14645,8742,14556,8381,14461,8020,14365,7603,15273,10603,15272,10607,15267,10619,15256,10631,15231,10614,15182,10535,15118,10389,15042,10167,14963,9787,14883,9447,14800,9115,14710,8665,14615,8318,14514,7911,14411,7507,14279,7198,15314,9675,15313,9683,15309,9712,15298,9759,15277,9797,15229,9773,15166,9668,15084,9487,14995,9274,14898,8910,14800,8539,14697,8234,14590,7790,14479,7409,14367,7067,14178,6621,15337,8619,15337,8631,15333,8677,15325,8769,15305,8871,15264,8940,15202,8909,15119,8775,15022,8565,14916,8328,14804,8009,14688,7614,14569,7287,14448,6888,14321,6483,14088,6171,15350,7402,15350,7419,15347,7480,15340,7613,15322,7804,15287,7973,15229,8057,15148,8012,15046,7846,14933,7611,14810,7357,14682,7069,14552,6656,14421,6316,14251,5948,14007,5528,15356,5942,15356,5977,15353,6119,15348,6294,15332,6551,15302,6824,15249,7044,15171,7122,15070,7050,14949,6861,14818,6611,14679,6349,14538,6067,14398,5651,14189,5311,13935,4958,15359,4123,15359,4153,15356,4296,15353,4646,15338,5160,15311,5508,15263,5829,15188,6042,15088,6094,14966,6001,14826,5796,14678,5543,14527,5287,14377,4985,14133,4586,13869,4257,15360,1563,15360,1642,15358,2076,15354,2636,15341,3350,15317,4019,15273,4429,15203,4732,15105,4911,14981,4932,14836,4818,14679,4621,14517,4386,14359,4156,14083,3795,13808,3437,15360,122,15360,137,15358,285,15355,636,15344,1274,15322,2177,15281,2765,15215,3223,15120,3451,14995,3569,14846,3567,14681,3466,14511,3305,14344,3121,14037,2800,13753,2467,15360,0,15360,1,15359,21,15355,89,15346,253,15325,479,15287,796,15225,1148,15133,1492,15008,1749,14856,1882,14685,1886,14506,1783,14324,1608,13996,1398,13702,1183]),jn=null;function kA(){return jn===null&&(jn=new Hl(BA,16,16,Ji,Vn),jn.name="DFG_LUT",jn.minFilter=Ke,jn.magFilter=Ke,jn.wrapS=qn,jn.wrapT=qn,jn.generateMipmaps=!1,jn.needsUpdate=!0),jn}var oh=class{constructor(t={}){let{canvas:e=P0(),context:i=null,depth:s=!0,stencil:r=!1,alpha:o=!1,antialias:a=!1,premultipliedAlpha:c=!0,preserveDrawingBuffer:l=!1,powerPreference:h="default",failIfMajorPerformanceCaveat:u=!1,reversedDepthBuffer:f=!1,outputBufferType:d=rn}=t;this.isWebGLRenderer=!0;let m;if(i!==null){if(typeof WebGLRenderingContext<"u"&&i instanceof WebGLRenderingContext)throw new Error("THREE.WebGLRenderer: WebGL 1 is not supported since r163.");m=i.getContextAttributes().alpha}else m=o;let _=d,p=new Set([wc,Sc,Mc]),g=new Set([rn,kn,Fr,Ns,vc,bc]),x=new Uint32Array(4),b=new Int32Array(4),v={textures:[],min:[],max:[],resolution:[]},w=null,E=null,y=[],M=[],L=null;this.domElement=e,this.debug={checkShaderErrors:!0,diagnostics:{keywords:!1},onShaderError:null},this.autoClear=!0,this.autoClearColor=!0,this.autoClearDepth=!0,this.autoClearStencil=!0,this.sortObjects=!0,this.clippingPlanes=[],this.localClippingEnabled=!1,this.toneMapping=Jn,this.toneMappingExposure=1,this.transmissionResolutionScale=1;let R=this,D=!1,N=null,B=null,C=null,z=null;this._outputColorSpace=Ze;let $=0,G=0,st=null,X=-1,Z=null,it=new oe,Mt=new oe,Dt=null,j=new Gt(0),W=0,et=e.width,ot=e.height,O=1,K=null,Tt=null,ct=new oe(0,0,et,ot),Rt=new oe(0,0,et,ot),St=!1,Pt=new Vi,qt=new Wl,ee=!1,xe=!1,jt=new re,le=new P,Qt=new oe,ke={background:null,fog:null,environment:null,overrideMaterial:null,isScene:!0},mn=!1;function gn(){return st===null?O:1}let F=i;function _n(A,U){return e.getContext(A,U)}let pe,me,yt,Me,Ut,kt,T,S,V,rt,nt,ut,gt,J,Q,dt,I,tt,Y,pt,lt,ft,It;try{let A={alpha:!0,depth:s,stencil:r,antialias:a,premultipliedAlpha:c,preserveDrawingBuffer:l,powerPreference:h,failIfMajorPerformanceCaveat:u};if("setAttribute"in e&&e.setAttribute("data-engine",`three.js r${"187"}`),e.addEventListener("webglcontextlost",Lt,!1),e.addEventListener("webglcontextrestored",Ht,!1),e.addEventListener("webglcontextcreationerror",vt,!1),F===null){let U="webgl2";if(F=_n(U,A),F===null)throw _n(U)?new Error("THREE.WebGLRenderer: Error creating WebGL context with your selected attributes."):new Error("THREE.WebGLRenderer: Error creating WebGL context.")}Wt()}catch(A){throw e.removeEventListener("webglcontextlost",Lt,!1),e.removeEventListener("webglcontextrestored",Ht,!1),e.removeEventListener("webglcontextcreationerror",vt,!1),Ot("WebGLRenderer: "+A.message),A}function Wt(){pe=new Jw(F),pe.init(),lt=new LA(F,pe),me=new kw(F,pe,t,lt),yt=new PA(F,pe),me.reversedDepthBuffer&&f&&yt.buffers.depth.setReversed(!0),B=F.createFramebuffer(),C=F.createFramebuffer(),z=F.createFramebuffer(),Me=new Qw(F),Ut=new gA,kt=new IA(F,pe,yt,Ut,me,lt,Me),T=new Zw(R),S=new eM(F),ft=new Fw(F,S),V=new jw(F,S,Me,ft),rt=new e1(F,V,S,ft,Me),tt=new t1(F,me,kt),Q=new zw(Ut),nt=new mA(R,T,pe,me,ft,Q),ut=new OA(R,Ut),gt=new xA,J=new wA(pe),I=new Ow(R,T,yt,rt,m,c),dt=new RA(R,rt,me),It=new FA(F,Me,me,yt),Y=new Bw(F,pe,Me),pt=new Kw(F,pe,Me),Me.programs=nt.programs,R.capabilities=me,R.extensions=pe,R.properties=Ut,R.renderLists=gt,R.shadowMap=dt,R.state=yt,R.info=Me}_!==rn&&(L=new i1(_,e.width,e.height,a,s,r));let at=new dd(R,F);this.xr=at,this.getContext=function(){return F},this.getContextAttributes=function(){return F.getContextAttributes()},this.forceContextLoss=function(){let A=pe.get("WEBGL_lose_context");A&&A.loseContext()},this.forceContextRestore=function(){let A=pe.get("WEBGL_lose_context");A&&A.restoreContext()},this.getPixelRatio=function(){return O},this.setPixelRatio=function(A){A!==void 0&&(O=A,this.setSize(et,ot,!1))},this.getSize=function(A){return A.set(et,ot)},this.setSize=function(A,U,q=!0){if(at.isPresenting){Nt("WebGLRenderer: Can't change size while VR device is presenting.");return}et=A,ot=U,e.width=Math.floor(A*O),e.height=Math.floor(U*O),q===!0&&(e.style.width=A+"px",e.style.height=U+"px"),L!==null&&L.setSize(e.width,e.height),this.setViewport(0,0,A,U)},this.getDrawingBufferSize=function(A){return A.set(et*O,ot*O).floor()},this.setDrawingBufferSize=function(A,U,q){et=A,ot=U,O=q,e.width=Math.floor(A*q),e.height=Math.floor(U*q),this.setViewport(0,0,A,U)},this.setEffects=function(A){if(_===rn){Ot("WebGLRenderer: setEffects() requires outputBufferType set to HalfFloatType or FloatType.");return}if(A){for(let U=0;U<A.length;U++)if(A[U].isOutputPass===!0){Nt("WebGLRenderer: OutputPass is not needed in setEffects(). Tone mapping and color space conversion are applied automatically.");break}}L.setEffects(A||[])},this.getCurrentViewport=function(A){return A.copy(it)},this.getViewport=function(A){return A.copy(ct)},this.setViewport=function(A,U,q,k){A.isVector4?ct.set(A.x,A.y,A.z,A.w):ct.set(A,U,q,k),yt.viewport(it.copy(ct).multiplyScalar(gn()).round())},this.getScissor=function(A){return A.copy(Rt)},this.setScissor=function(A,U,q,k){A.isVector4?Rt.set(A.x,A.y,A.z,A.w):Rt.set(A,U,q,k),yt.scissor(Mt.copy(Rt).multiplyScalar(gn()).round())},this.getScissorTest=function(){return St},this.setScissorTest=function(A){yt.setScissorTest(St=A)},this.setOpaqueSort=function(A){K=A},this.setTransparentSort=function(A){Tt=A},this.getClearColor=function(A){return A.copy(I.getClearColor())},this.setClearColor=function(){I.setClearColor(...arguments)},this.getClearAlpha=function(){return I.getClearAlpha()},this.setClearAlpha=function(){I.setClearAlpha(...arguments)},this.clear=function(A=!0,U=!0,q=!0){let k=0;if(A){let H=!1;if(st!==null){let _t=st.texture.format;H=p.has(_t)}if(H){let _t=st.texture.type,wt=g.has(_t),mt=I.getClearColor(),bt=I.getClearAlpha(),Ct=mt.r,zt=mt.g,Yt=mt.b;wt?(x[0]=Ct,x[1]=zt,x[2]=Yt,x[3]=bt,F.clearBufferuiv(F.COLOR,0,x)):(b[0]=Ct,b[1]=zt,b[2]=Yt,b[3]=bt,F.clearBufferiv(F.COLOR,0,b))}else k|=F.COLOR_BUFFER_BIT}U&&(k|=F.DEPTH_BUFFER_BIT,this.state.buffers.depth.setMask(!0)),q&&(k|=F.STENCIL_BUFFER_BIT,this.state.buffers.stencil.setMask(4294967295)),k!==0&&F.clear(k)},this.clearColor=function(){this.clear(!0,!1,!1)},this.clearDepth=function(){this.clear(!1,!0,!1)},this.clearStencil=function(){this.clear(!1,!1,!0)},this.setNodesHandler=function(A){A.setRenderer(this),N=A},this.dispose=function(){e.removeEventListener("webglcontextlost",Lt,!1),e.removeEventListener("webglcontextrestored",Ht,!1),e.removeEventListener("webglcontextcreationerror",vt,!1),I.dispose(),gt.dispose(),J.dispose(),kt.dispose(),Ut.dispose(),T.dispose(),rt.dispose(),V.dispose(),ft.dispose(),It.dispose(),nt.dispose(),at.dispose(),at.removeEventListener("sessionstart",Ed),at.removeEventListener("sessionend",Td),Qi.stop()};function Lt(A){A.preventDefault(),Mo("WebGLRenderer: Context Lost."),D=!0}function Ht(){Mo("WebGLRenderer: Context Restored."),D=!1;let A=Me.autoReset,U=dt.enabled,q=dt.autoUpdate,k=dt.needsUpdate,H=dt.type;Wt(),Me.autoReset=A,dt.enabled=U,dt.autoUpdate=q,dt.needsUpdate=k,dt.type=H}function vt(A){Ot("WebGLRenderer: A WebGL context could not be created. Reason: ",A.statusMessage)}function ce(A){let U=A.target;U.removeEventListener("dispose",ce),Ee(U)}function Ee(A){Ei(A),Ut.remove(A)}function Ei(A){let U=Ut.get(A).programs;U!==void 0&&(U.forEach(function(q){nt.releaseProgram(q)}),A.isShaderMaterial&&nt.releaseShaderCache(A))}this.renderBufferDirect=function(A,U,q,k,H,_t){U===null&&(U=ke);let wt=H.isMesh&&H.matrixWorld.determinantAffine()<0,mt=Z_(A,U,q,k,H);yt.setMaterial(k,wt);let bt=q.index,Ct=1;if(k.wireframe===!0){if(bt=V.getWireframeAttribute(q),bt===void 0)return;Ct=2}let zt=q.drawRange,Yt=q.attributes.position,At=zt.start*Ct,Zt=(zt.start+zt.count)*Ct;_t!==null&&(At=Math.max(At,_t.start*Ct),Zt=Math.min(Zt,(_t.start+_t.count)*Ct)),bt!==null?(At=Math.max(At,0),Zt=Math.min(Zt,bt.count)):Yt!=null&&(At=Math.max(At,0),Zt=Math.min(Zt,Yt.count));let ye=Zt-At;if(ye<0||ye===1/0)return;ft.setup(H,k,mt,q,bt);let ue,he=Y;if(bt!==null&&(ue=S.get(bt),he=pt,he.setIndex(ue)),H.isMesh)k.wireframe===!0?(yt.setLineWidth(k.wireframeLinewidth*gn()),he.setMode(F.LINES)):he.setMode(F.TRIANGLES);else if(H.isLine){let ze=k.linewidth;ze===void 0&&(ze=1),yt.setLineWidth(ze*gn()),H.isLineSegments?he.setMode(F.LINES):H.isLineLoop?he.setMode(F.LINE_LOOP):he.setMode(F.LINE_STRIP)}else H.isPoints?he.setMode(F.POINTS):H.isSprite&&he.setMode(F.TRIANGLES);if(H.isBatchedMesh)if(pe.get("WEBGL_multi_draw"))he.renderMultiDraw(H._multiDrawStarts,H._multiDrawCounts,H._multiDrawCount);else{let ze=H._multiDrawStarts,Et=H._multiDrawCounts,qe=H._multiDrawCount,ne=bt?S.get(bt).bytesPerElement:1,ts=Ut.get(k).currentProgram.getUniforms();for(let Ve=0;Ve<qe;Ve++)ts.setValue(F,"_gl_DrawID",Ve),he.render(ze[Ve]/ne,Et[Ve])}else if(H.isInstancedMesh)he.renderInstances(At,ye,H.count);else if(q.isInstancedBufferGeometry){let ze=q._maxInstanceCount!==void 0?q._maxInstanceCount:1/0,Et=Math.min(q.instanceCount,ze);he.renderInstances(At,ye,Et)}else he.render(At,ye)};function Ad(A,U,q,k){N!==null&&A.isNodeMaterial&&N.setObject(k,A),ee===!0&&Q.setState(A,q,!1),A.transparent===!0&&A.side===Tn&&A.forceSinglePass===!1?(A.side=Ue,A.needsUpdate=!0,Wr(A,U,k),A.side=Zi,A.needsUpdate=!0,Wr(A,U,k),A.side=Tn):Wr(A,U,k)}this.compile=function(A,U,q=null){q===null&&(q=A),N!==null&&N.renderStart(A,U,q),E=J.get(q),E.init(U),M.push(E),q.traverseVisible(function(H){H.isLight&&H.layers.test(U.layers)&&(E.pushLight(H),H.castShadow&&E.pushShadow(H))}),A!==q&&A.traverseVisible(function(H){H.isLight&&H.layers.test(U.layers)&&(E.pushLight(H),H.castShadow&&E.pushShadow(H))}),E.setupLights(),N!==null&&N.updateLights(E.state.lightsArray),xe=this.localClippingEnabled,ee=Q.init(this.clippingPlanes,xe),ee===!0&&Q.setGlobalState(this.clippingPlanes,U),N!==null&&dt.render(E.state.shadowsArray,q,U);let k=new Set;return A.traverse(function(H){if(!(H.isMesh||H.isPoints||H.isLine||H.isSprite))return;let _t=H.material;if(_t)if(Array.isArray(_t))for(let wt=0;wt<_t.length;wt++){let mt=_t[wt];Ad(mt,q,U,H),k.add(mt)}else Ad(_t,q,U,H),k.add(_t)}),E=M.pop(),N!==null&&N.renderEnd(),k},this.compileAsync=function(A,U,q=null){let k=this.compile(A,U,q);return new Promise(H=>{function _t(){if(k.forEach(function(wt){let bt=Ut.get(wt).currentProgram;(bt===void 0||bt.isReady())&&k.delete(wt)}),k.size===0){H(A);return}setTimeout(_t,10)}pe.get("KHR_parallel_shader_compile")!==null?_t():setTimeout(_t,10)})};let Mh=null;function q_(A){Mh&&Mh(A)}function Ed(){Qi.stop()}function Td(){Qi.start()}let Qi=new l_;Qi.setAnimationLoop(q_),typeof self<"u"&&Qi.setContext(self),this.setAnimationLoop=function(A){Mh=A,at.setAnimationLoop(A),A===null?Qi.stop():Qi.start()},at.addEventListener("sessionstart",Ed),at.addEventListener("sessionend",Td),this.render=function(A,U){if(U!==void 0&&U.isCamera!==!0){Ot("WebGLRenderer.render: camera is not an instance of THREE.Camera.");return}if(D===!0)return;N!==null&&N.renderStart(A,U);let q=at.enabled===!0&&at.isPresenting===!0,k=L!==null&&(st===null||q)&&L.begin(R,st);if(A.matrixWorldAutoUpdate===!0&&A.updateMatrixWorld(),U.parent===null&&U.matrixWorldAutoUpdate===!0&&U.updateMatrixWorld(),at.enabled===!0&&at.isPresenting===!0&&(L===null||L.isCompositing()===!1)&&(at.cameraAutoUpdate===!0&&at.updateCamera(U),U=at.getCamera()),A.isScene===!0&&A.onBeforeRender(R,A,U,st),E=J.get(A,M.length),E.init(U),E.state.textureUnits=kt.getTextureUnits(),M.push(E),jt.multiplyMatrices(U.projectionMatrix,U.matrixWorldInverse),U.isArrayCamera?qt.setFromArrayCamera(U):Pt.setFromProjectionMatrix(jt,wn,U.reversedDepth),xe=this.localClippingEnabled,ee=Q.init(this.clippingPlanes,xe),w=gt.get(A,y.length),w.init(),y.push(w),this.info.render.frame++,at.enabled===!0&&at.isPresenting===!0){let wt=R.xr.getDepthSensingMesh();wt!==null&&Sh(wt,U,-1/0,R.sortObjects)}Sh(A,U,0,R.sortObjects),w.finish(),N!==null&&N.updateLights(E.state.lightsArray),R.sortObjects===!0&&w.sort(K,Tt),mn=at.enabled===!1||at.isPresenting===!1||at.hasDepthSensing()===!1,mn&&I.addToRenderList(w,A),this.info.autoReset===!0&&this.info.reset(),ee===!0&&Q.beginShadows();let H=E.state.shadowsArray;if(dt.render(H,A,U),ee===!0&&Q.endShadows(),(k&&L.hasRenderPass())===!1){let wt=w.opaque,mt=w.transmissive;if(E.setupLights(),U.isArrayCamera){let bt=U.cameras;if(mt.length>0)for(let Ct=0,zt=bt.length;Ct<zt;Ct++){let Yt=bt[Ct];Rd(wt,mt,A,Yt)}mn&&I.render(A);for(let Ct=0,zt=bt.length;Ct<zt;Ct++){let Yt=bt[Ct];Cd(w,A,Yt,Yt.viewport)}}else mt.length>0&&Rd(wt,mt,A,U),mn&&I.render(A),Cd(w,A,U)}st!==null&&G===0&&(kt.updateMultisampleRenderTarget(st),kt.updateRenderTargetMipmap(st)),k&&L.end(R),A.isScene===!0&&A.onAfterRender(R,A,U),ft.resetDefaultState(),X=-1,Z=null,M.pop(),M.length>0?(E=M[M.length-1],kt.setTextureUnits(E.state.textureUnits),ee===!0&&Q.setGlobalState(R.clippingPlanes,E.state.camera)):E=null,y.pop(),y.length>0?w=y[y.length-1]:w=null,N!==null&&N.renderEnd()};function Sh(A,U,q,k){if(A.visible===!1)return;if(A.layers.test(U.layers)){if(A.isGroup)q=A.renderOrder;else if(A.isLOD)A.autoUpdate===!0&&A.update(U);else if(A.isLight)E.pushLight(A),A.castShadow&&E.pushShadow(A);else if(A.isSprite){let wt=U.isArrayCamera?qt:Pt;if(!A.frustumCulled||A.intersectsFrustum(wt)){k&&Qt.setFromMatrixPosition(A.matrixWorld).applyMatrix4(jt);let mt=rt.update(A),bt=A.material;bt.visible&&w.push(A,mt,bt,q,Qt.z,null,U)}}else if(A.isMesh||A.isLine||A.isPoints){let wt=U.isArrayCamera?qt:Pt;if(!A.frustumCulled||A.intersectsFrustum(wt)){let mt=rt.update(A),bt=A.material;if(k&&(A.boundingSphere!==void 0?(A.boundingSphere===null&&A.computeBoundingSphere(),Qt.copy(A.boundingSphere.center)):(mt.boundingSphere===null&&mt.computeBoundingSphere(),Qt.copy(mt.boundingSphere.center)),Qt.applyMatrix4(A.matrixWorld).applyMatrix4(jt)),Array.isArray(bt)){let Ct=mt.groups;for(let zt=0,Yt=Ct.length;zt<Yt;zt++){let At=Ct[zt],Zt=bt[At.materialIndex];Zt&&Zt.visible&&w.push(A,mt,Zt,q,Qt.z,At,U)}}else bt.visible&&w.push(A,mt,bt,q,Qt.z,null,U)}}}let _t=A.children;for(let wt=0,mt=_t.length;wt<mt;wt++)Sh(_t[wt],U,q,k)}function Cd(A,U,q,k){let{opaque:H,transmissive:_t,transparent:wt}=A;E.setupLightsView(q),ee===!0&&Q.setGlobalState(R.clippingPlanes,q),k&&yt.viewport(it.copy(k)),H.length>0&&ga(H,U,q),_t.length>0&&ga(_t,U,q),wt.length>0&&ga(wt,U,q),yt.buffers.depth.setTest(!0),yt.buffers.depth.setMask(!0),yt.buffers.color.setMask(!0),yt.setPolygonOffset(!1)}function Rd(A,U,q,k){if((q.isScene===!0?q.overrideMaterial:null)!==null)return;if(E.state.transmissionRenderTarget[k.id]===void 0){let At=pe.has("EXT_color_buffer_half_float")||pe.has("EXT_color_buffer_float");E.state.transmissionRenderTarget[k.id]=new hn(1,1,{generateMipmaps:!0,type:At?Vn:rn,minFilter:bi,samples:Math.max(4,me.samples),stencilBuffer:r,resolveDepthBuffer:!1,resolveStencilBuffer:!1,storeMultisampledDepthBuffer:!1,storeMultisampledStencilBuffer:!1,colorSpace:Jt.workingColorSpace})}let _t=E.state.transmissionRenderTarget[k.id],wt=k.viewport||it;_t.setSize(wt.z*R.transmissionResolutionScale,wt.w*R.transmissionResolutionScale);let mt=R.getRenderTarget(),bt=R.getActiveCubeFace(),Ct=R.getActiveMipmapLevel();R.setRenderTarget(_t),R.getClearColor(j),W=R.getClearAlpha(),W<1&&R.setClearColor(16777215,.5),R.clear(),mn&&I.render(q);let zt=R.toneMapping;R.toneMapping=Jn;let Yt=k.viewport;if(k.viewport!==void 0&&(k.viewport=void 0),E.setupLightsView(k),ee===!0&&Q.setGlobalState(R.clippingPlanes,k),ga(A,q,k),kt.updateMultisampleRenderTarget(_t),kt.updateRenderTargetMipmap(_t),pe.has("WEBGL_multisampled_render_to_texture")===!1){let At=!1;for(let Zt=0,ye=U.length;Zt<ye;Zt++){let ue=U[Zt],{object:he,geometry:ze,material:Et,group:qe}=ue;if(Et.side===Tn&&he.layers.test(k.layers)){let ne=Et.side;Et.side=Ue,Et.needsUpdate=!0,Pd(he,q,k,ze,Et,qe),Et.side=ne,Et.needsUpdate=!0,At=!0}}At===!0&&(kt.updateMultisampleRenderTarget(_t),kt.updateRenderTargetMipmap(_t))}R.setRenderTarget(mt,bt,Ct),R.setClearColor(j,W),Yt!==void 0&&(k.viewport=Yt),R.toneMapping=zt}function ga(A,U,q){let k=U.isScene===!0?U.overrideMaterial:null;for(let H=0,_t=A.length;H<_t;H++){let wt=A[H],{object:mt,geometry:bt,group:Ct}=wt,zt=wt.material;zt.allowOverride===!0&&k!==null&&(zt=k),mt.layers.test(q.layers)&&Pd(mt,U,q,bt,zt,Ct)}}function Pd(A,U,q,k,H,_t){N!==null&&H.isNodeMaterial&&N.setObject(A,H),A.onBeforeRender(R,U,q,k,H,_t),A.modelViewMatrix.multiplyMatrices(q.matrixWorldInverse,A.matrixWorld),A.normalMatrix.getNormalMatrix(A.modelViewMatrix),H.onBeforeRender(R,U,q,k,A,_t),H.transparent===!0&&H.side===Tn&&H.forceSinglePass===!1?(H.side=Ue,H.needsUpdate=!0,R.renderBufferDirect(q,U,k,H,A,_t),H.side=Zi,H.needsUpdate=!0,R.renderBufferDirect(q,U,k,H,A,_t),H.side=Tn):R.renderBufferDirect(q,U,k,H,A,_t),A.onAfterRender(R,U,q,k,H,_t)}function Id(A){let U=0;for(let q of A)q.texture!==null&&U++;return U}function Wr(A,U,q){U.isScene!==!0&&(U=ke);let k=Ut.get(A),H=E.state.lights,_t=E.state.shadowsArray,wt=H.state.version,mt=nt.getParameters(A,H.state,_t,U,q,E.state.lightProbeGridArray),bt=nt.getProgramCacheKey(mt),Ct=k.programs;k.environment=A.isMeshStandardMaterial||A.isMeshLambertMaterial||A.isMeshPhongMaterial?U.environment:null,k.fog=U.fog;let zt=A.isMeshStandardMaterial||A.isMeshLambertMaterial&&!A.envMap||A.isMeshPhongMaterial&&!A.envMap;k.envMap=T.get(A.envMap||k.environment,zt),k.envMapRotation=k.environment!==null&&A.envMap===null?U.environmentRotation:A.envMapRotation,Ct===void 0&&(A.addEventListener("dispose",ce),Ct=new Map,k.programs=Ct,k.programVariants=new Map);let Yt=Ct.get(bt);if(Yt!==void 0){if(k.currentProgram===Yt&&k.lightsStateVersion===wt)return Nd(A,mt),Yt}else mt.uniforms=nt.getUniforms(A),N!==null&&A.isNodeMaterial&&N.build(A,q,mt),A.onBeforeCompile(mt,R),Yt=nt.acquireProgram(mt,bt),Ct.set(bt,Yt),k.uniforms=mt.uniforms;let At=k.uniforms;return(!A.isShaderMaterial&&!A.isRawShaderMaterial||A.clipping===!0)&&(At.clippingPlanes=Q.uniform),Nd(A,mt),k.needsLights=j_(A),k.lightsStateVersion=wt,k.needsLights&&(At.ambientLightColor.value=H.state.ambient,At.lightProbe.value=H.state.probe,At.sunLights.value=H.state.sun,At.sunLightShadows.value=H.state.sunShadow,At.directionalLights.value=H.state.directional,At.directionalLightShadows.value=H.state.directionalShadow,At.spotLights.value=H.state.spot,At.spotLightShadows.value=H.state.spotShadow,At.rectAreaLights.value=H.state.rectArea,At.ltc_1.value=H.state.rectAreaLTC1,At.ltc_2.value=H.state.rectAreaLTC2,At.pointLights.value=H.state.point,At.pointLightShadows.value=H.state.pointShadow,At.hemisphereLights.value=H.state.hemi,At.sunShadowMatrix.value=H.state.sunShadowMatrix,At.sunShadowCascade.value=H.state.sunShadowCascade,At.directionalShadowMatrix.value=H.state.directionalShadowMatrix,At.spotLightMatrix.value=H.state.spotLightMatrix,At.spotLightMap.value=H.state.spotLightMap,At.pointShadowMatrix.value=H.state.pointShadowMatrix),k.numLightProbeGrids=Id(E.state.lightProbeGridArray),k.currentProgram=Yt,k.uniformsList=null,Yt}function Y_(A,U,q,k,H){let _t=Ut.get(A),wt=_t.currentProgram.id+","+k+","+H,mt=_t.programVariants.get(wt);return mt===void 0?(mt=Wr(A,U,q),_t.programVariants.set(wt,mt)):(_t.currentProgram=mt,_t.uniformsList=null,_t.outputColorSpace=k,_t.toneMapping=H),mt}function Ld(A){if(A.uniformsList===null){let U=A.currentProgram.getUniforms();A.uniformsList=Br.seqWithValue(U.seq,A.uniforms)}return A.uniformsList}function Nd(A,U){let q=Ut.get(A);q.outputColorSpace=U.outputColorSpace,q.batching=U.batching,q.batchingColor=U.batchingColor,q.instancing=U.instancing,q.instancingColor=U.instancingColor,q.instancingMorph=U.instancingMorph,q.skinning=U.skinning,q.morphTargets=U.morphTargets,q.morphNormals=U.morphNormals,q.morphColors=U.morphColors,q.morphTargetsCount=U.morphTargetsCount,q.numClippingPlanes=U.numClippingPlanes,q.numIntersection=U.numClipIntersection,q.vertexAlphas=U.vertexAlphas,q.vertexTangents=U.vertexTangents,q.toneMapping=U.toneMapping}function Z_(A,U,q,k,H){U.isScene!==!0&&(U=ke),kt.resetTextureUnits();let _t=U.fog,wt=k.isMeshStandardMaterial||k.isMeshLambertMaterial||k.isMeshPhongMaterial?U.environment:null,mt=st===null?R.outputColorSpace:st.isXRRenderTarget===!0?st.texture.colorSpace:Jt.workingColorSpace,bt=k.isMeshStandardMaterial||k.isMeshLambertMaterial&&!k.envMap||k.isMeshPhongMaterial&&!k.envMap,Ct=T.get(k.envMap||wt,bt),zt=k.vertexColors===!0&&!!q.attributes.color&&q.attributes.color.itemSize===4,Yt=!!q.attributes.tangent&&(!!k.normalMap||k.anisotropy>0),At=!!q.morphAttributes.position,Zt=!!q.morphAttributes.normal,ye=!!q.morphAttributes.color,ue=Jn;k.toneMapped&&(st===null||st.isXRRenderTarget===!0)&&(ue=R.toneMapping);let he=q.morphAttributes.position||q.morphAttributes.normal||q.morphAttributes.color,ze=he!==void 0?he.length:0,Et=Ut.get(k),qe=E.state.lights;if(ee===!0&&(xe===!0||A!==Z)){let ge=A===Z&&k.id===X;Q.setState(k,A,ge)}let ne=!1,ts=!1;k.version===Et.__version?Et.needsLights&&Et.lightsStateVersion!==qe.state.version||H.isBatchedMesh&&Et.batching===!1||!H.isBatchedMesh&&Et.batching===!0||H.isBatchedMesh&&Et.batchingColor===!0&&H._colorsTexture===null||H.isBatchedMesh&&Et.batchingColor===!1&&H._colorsTexture!==null||H.isInstancedMesh&&Et.instancing===!1||!H.isInstancedMesh&&Et.instancing===!0||H.isSkinnedMesh&&Et.skinning===!1||!H.isSkinnedMesh&&Et.skinning===!0||H.isInstancedMesh&&Et.instancingColor===!0&&H.instanceColor===null||H.isInstancedMesh&&Et.instancingColor===!1&&H.instanceColor!==null||H.isInstancedMesh&&Et.instancingMorph===!0&&H.morphTexture===null||H.isInstancedMesh&&Et.instancingMorph===!1&&H.morphTexture!==null||Et.envMap!==Ct||k.fog===!0&&Et.fog!==_t||Et.numClippingPlanes!==void 0&&(Et.numClippingPlanes!==Q.numPlanes||Et.numIntersection!==Q.numIntersection)||Et.vertexAlphas!==zt||Et.vertexTangents!==Yt||Et.morphTargets!==At||Et.morphNormals!==Zt||Et.morphColors!==ye||Et.morphTargetsCount!==ze||Et.numLightProbeGrids!==Id(E.state.lightProbeGridArray)?ne=!0:(Et.outputColorSpace!==mt||Et.toneMapping!==ue)&&(ts=!0):(ne=!0,Et.__version=k.version);let Ve=Et.currentProgram;(ne===!0||ts===!0)&&(Ve=ts===!0?Y_(k,U,H,mt,ue):Wr(k,U,H),N&&k.isNodeMaterial&&N.onUpdateProgram(k,Ve,Et));let _a=!1,Ti=!1,es=!1,te=Ve.getUniforms(),Ie=Et.uniforms;if(yt.useProgram(Ve.program)&&(_a=!0,Ti=!0,es=!0),k.id!==X&&(X=k.id,Ti=!0),_a||Z!==A){yt.buffers.depth.getReversed()&&A.reversedDepth!==!0&&(A._reversedDepth=!0,A.updateProjectionMatrix()),te.setValue(F,"projectionMatrix",A.projectionMatrix),te.setValue(F,"viewMatrix",A.matrixWorldInverse);let Te=te.map.cameraPosition;Te!==void 0&&Te.setValue(F,le.setFromMatrixPosition(A.matrixWorld)),me.logarithmicDepthBuffer&&te.setValue(F,"logDepthBufFC",2/(Math.log(A.far+1)/Math.LN2)),(k.isMeshPhongMaterial||k.isMeshToonMaterial||k.isMeshLambertMaterial||k.isMeshBasicMaterial||k.isMeshStandardMaterial||k.isShaderMaterial)&&te.setValue(F,"isOrthographic",A.isOrthographicCamera===!0),Z!==A&&(Z=A,Ti=!0,es=!0)}if(Et.needsLights&&(qe.state.sunShadowMap.length>0&&te.setValue(F,"sunShadowMap",qe.state.sunShadowMap,kt),qe.state.directionalShadowMap.length>0&&te.setValue(F,"directionalShadowMap",qe.state.directionalShadowMap,kt),qe.state.spotShadowMap.length>0&&te.setValue(F,"spotShadowMap",qe.state.spotShadowMap,kt),qe.state.pointShadowMap.length>0&&te.setValue(F,"pointShadowMap",qe.state.pointShadowMap,kt)),H.isSkinnedMesh){te.setOptional(F,H,"bindMatrix"),te.setOptional(F,H,"bindMatrixInverse");let ge=H.skeleton;ge&&(ge.boneTexture===null&&ge.computeBoneTexture(),te.setValue(F,"boneTexture",ge.boneTexture,kt))}H.isBatchedMesh&&(te.setOptional(F,H,"batchingTexture"),te.setValue(F,"batchingTexture",H._matricesTexture,kt),te.setOptional(F,H,"batchingIdTexture"),te.setValue(F,"batchingIdTexture",H._indirectTexture,kt),te.setOptional(F,H,"batchingColorTexture"),H._colorsTexture!==null&&te.setValue(F,"batchingColorTexture",H._colorsTexture,kt));let Rn=q.morphAttributes;if((Rn.position!==void 0||Rn.normal!==void 0||Rn.color!==void 0)&&tt.update(H,q,Ve),(Ti||Et.receiveShadow!==H.receiveShadow)&&(Et.receiveShadow=H.receiveShadow,te.setValue(F,"receiveShadow",H.receiveShadow)),(k.isMeshStandardMaterial||k.isMeshLambertMaterial||k.isMeshPhongMaterial)&&k.envMap===null&&U.environment!==null&&(Ie.envMapIntensity.value=U.environmentIntensity),Ie.dfgLUT!==void 0&&(Ie.dfgLUT.value=kA()),Ti){if(te.setValue(F,"toneMappingExposure",R.toneMappingExposure),Et.needsLights&&J_(Ie,es),_t&&k.fog===!0&&ut.refreshFogUniforms(Ie,_t),ut.refreshMaterialUniforms(Ie,k,O,ot,E.state.transmissionRenderTarget[A.id]),Et.needsLights&&Et.numLightProbeGrids>0){let ge=v,Te=0;for(let ni of E.state.lightProbeGridArray)ni.texture!==null&&(ge.textures[Te]=ni.texture,ge.min[Te]=ni.boundingBox.min,ge.max[Te]=ni.boundingBox.max,ge.resolution[Te]=ni.resolution,Te++);for(let ni in ge)ge[ni].length=Te;Ie.probesSH.value=ge.textures,Ie.probesMin.value=ge.min,Ie.probesMax.value=ge.max,Ie.probesResolution.value=ge.resolution}Br.upload(F,Ld(Et),Ie,kt)}if(k.isShaderMaterial&&k.uniformsNeedUpdate===!0&&(Br.upload(F,Ld(Et),Ie,kt),k.uniformsNeedUpdate=!1),k.isSpriteMaterial&&te.setValue(F,"center",H.center),te.setValue(F,"modelViewMatrix",H.modelViewMatrix),te.setValue(F,"normalMatrix",H.normalMatrix),te.setValue(F,"modelMatrix",H.matrixWorld),k.uniformsGroups!==void 0){let ge=k.uniformsGroups;for(let Te=0,ni=ge.length;Te<ni;Te++){let Ud=ge[Te];It.update(Ud,Ve),It.bind(Ud,Ve)}}return Ve}function J_(A,U){A.ambientLightColor.needsUpdate=U,A.lightProbe.needsUpdate=U,A.sunLights.needsUpdate=U,A.sunLightShadows.needsUpdate=U,A.directionalLights.needsUpdate=U,A.directionalLightShadows.needsUpdate=U,A.pointLights.needsUpdate=U,A.pointLightShadows.needsUpdate=U,A.spotLights.needsUpdate=U,A.spotLightShadows.needsUpdate=U,A.rectAreaLights.needsUpdate=U,A.hemisphereLights.needsUpdate=U}function j_(A){return A.isMeshLambertMaterial||A.isMeshToonMaterial||A.isMeshPhongMaterial||A.isMeshStandardMaterial||A.isShadowMaterial||A.isShaderMaterial&&A.lights===!0}this.getActiveCubeFace=function(){return $},this.getActiveMipmapLevel=function(){return G},this.getRenderTarget=function(){return st},this.setRenderTargetTextures=function(A,U,q){let k=Ut.get(A);k.__autoAllocateDepthBuffer=A.resolveDepthBuffer===!1,k.__autoAllocateDepthBuffer===!1&&(k.__useRenderToTexture=!1),Ut.get(A.texture).__webglTexture=U,Ut.get(A.depthTexture).__webglTexture=k.__autoAllocateDepthBuffer?void 0:q,k.__hasExternalTextures=!0},this.setRenderTargetFramebuffer=function(A,U){let q=Ut.get(A);q.__webglFramebuffer=U,q.__useDefaultFramebuffer=U===void 0},this.setRenderTarget=function(A,U=0,q=0){st=A,$=U,G=q;let k=null,H=!1,_t=!1;if(A){let mt=Ut.get(A);if(mt.__useDefaultFramebuffer!==void 0){yt.bindFramebuffer(F.FRAMEBUFFER,mt.__webglFramebuffer),it.copy(A.viewport),Mt.copy(A.scissor),Dt=A.scissorTest,yt.viewport(it),yt.scissor(Mt),yt.setScissorTest(Dt),X=-1;return}else if(mt.__webglFramebuffer===void 0)kt.setupRenderTarget(A);else if(mt.__hasExternalTextures)kt.rebindTextures(A,Ut.get(A.texture).__webglTexture,Ut.get(A.depthTexture).__webglTexture);else if(A.depthBuffer){let zt=A.depthTexture;if(mt.__boundDepthTexture!==zt){if(zt!==null&&Ut.has(zt)&&(A.width!==zt.image.width||A.height!==zt.image.height))throw new Error("THREE.WebGLRenderer: Attached DepthTexture is initialized to the incorrect size.");kt.setupDepthRenderbuffer(A)}}let bt=A.texture;(bt.isData3DTexture||bt.isDataArrayTexture||bt.isCompressedArrayTexture)&&(_t=!0);let Ct=Ut.get(A).__webglFramebuffer;A.isWebGLCubeRenderTarget?(Array.isArray(Ct[U])?k=Ct[U][q]:k=Ct[U],H=!0):A.samples>0&&kt.useMultisampledRTT(A)===!1?k=Ut.get(A).__webglMultisampledFramebuffer:Array.isArray(Ct)?k=Ct[q]:k=Ct,it.copy(A.viewport),Mt.copy(A.scissor),Dt=A.scissorTest}else it.copy(ct).multiplyScalar(O).floor(),Mt.copy(Rt).multiplyScalar(O).floor(),Dt=St;if(q!==0&&(k=B),yt.bindFramebuffer(F.FRAMEBUFFER,k)&&yt.drawBuffers(A,k),yt.viewport(it),yt.scissor(Mt),yt.setScissorTest(Dt),H){let mt=Ut.get(A.texture);F.framebufferTexture2D(F.FRAMEBUFFER,F.COLOR_ATTACHMENT0,F.TEXTURE_CUBE_MAP_POSITIVE_X+U,mt.__webglTexture,q)}else if(_t){let mt=U;for(let bt=0;bt<A.textures.length;bt++){let Ct=Ut.get(A.textures[bt]);F.framebufferTextureLayer(F.FRAMEBUFFER,F.COLOR_ATTACHMENT0+bt,Ct.__webglTexture,q,mt)}}else if(A!==null&&q!==0){let mt=Ut.get(A.texture);F.framebufferTexture2D(F.FRAMEBUFFER,F.COLOR_ATTACHMENT0,F.TEXTURE_2D,mt.__webglTexture,q)}X=-1};function Dd(A){let U=Ut.get(A);return(U.__readFormat!==A.format||U.__readType!==A.type)&&(U.__readFormat=A.format,U.__readType=A.type,U.__formatReadable=me.textureFormatReadable(A.format),U.__typeReadable=me.textureTypeReadable(A.type)),U}this.readRenderTargetPixels=function(A,U,q,k,H,_t,wt,mt=0){if(!(A&&A.isWebGLRenderTarget)){Ot("WebGLRenderer.readRenderTargetPixels: renderTarget is not THREE.WebGLRenderTarget.");return}let bt=Ut.get(A).__webglFramebuffer;if(A.isWebGLCubeRenderTarget&&wt!==void 0&&(bt=bt[wt],Array.isArray(bt)&&(bt=bt[0])),bt){yt.bindFramebuffer(F.FRAMEBUFFER,bt);try{let Ct=A.textures[mt],zt=Ct.format,Yt=Ct.type;A.textures.length>1&&F.readBuffer(F.COLOR_ATTACHMENT0+mt);let At=Dd(Ct);if(At.__formatReadable===!1){Ot("WebGLRenderer.readRenderTargetPixels: renderTarget is not in RGBA or implementation defined format.");return}if(At.__typeReadable===!1){Ot("WebGLRenderer.readRenderTargetPixels: renderTarget is not in UnsignedByteType or implementation defined type.");return}U>=0&&U<=A.width-k&&q>=0&&q<=A.height-H&&F.readPixels(U,q,k,H,lt.convert(zt),lt.convert(Yt),_t)}finally{let Ct=st!==null?Ut.get(st).__webglFramebuffer:null;yt.bindFramebuffer(F.FRAMEBUFFER,Ct)}}},this.readRenderTargetPixelsAsync=async function(A,U,q,k,H,_t,wt,mt=0){if(!(A&&A.isWebGLRenderTarget))throw new Error("THREE.WebGLRenderer.readRenderTargetPixels: renderTarget is not THREE.WebGLRenderTarget.");let bt=Ut.get(A).__webglFramebuffer;if(A.isWebGLCubeRenderTarget&&wt!==void 0&&(bt=bt[wt],Array.isArray(bt)&&(bt=bt[0])),bt)if(U>=0&&U<=A.width-k&&q>=0&&q<=A.height-H){yt.bindFramebuffer(F.FRAMEBUFFER,bt);let Ct=A.textures[mt],zt=Ct.format,Yt=Ct.type;A.textures.length>1&&F.readBuffer(F.COLOR_ATTACHMENT0+mt);let At=Dd(Ct);if(At.__formatReadable===!1)throw new Error("THREE.WebGLRenderer.readRenderTargetPixelsAsync: renderTarget is not in RGBA or implementation defined format.");if(At.__typeReadable===!1)throw new Error("THREE.WebGLRenderer.readRenderTargetPixelsAsync: renderTarget is not in UnsignedByteType or implementation defined type.");let Zt=F.createBuffer();F.bindBuffer(F.PIXEL_PACK_BUFFER,Zt),F.bufferData(F.PIXEL_PACK_BUFFER,_t.byteLength,F.STREAM_READ),F.readPixels(U,q,k,H,lt.convert(zt),lt.convert(Yt),0),F.bindBuffer(F.PIXEL_PACK_BUFFER,null);let ye=st!==null?Ut.get(st).__webglFramebuffer:null;yt.bindFramebuffer(F.FRAMEBUFFER,ye);let ue=F.fenceSync(F.SYNC_GPU_COMMANDS_COMPLETE,0);return F.flush(),await L0(F,ue,4),F.bindBuffer(F.PIXEL_PACK_BUFFER,Zt),F.getBufferSubData(F.PIXEL_PACK_BUFFER,0,_t),F.bindBuffer(F.PIXEL_PACK_BUFFER,null),F.deleteBuffer(Zt),F.deleteSync(ue),_t}else throw new Error("THREE.WebGLRenderer.readRenderTargetPixelsAsync: requested read bounds are out of range.")},this.copyFramebufferToTexture=function(A,U=null,q=0){let k=Math.pow(2,-q),H=Math.floor(A.image.width*k),_t=Math.floor(A.image.height*k),wt=U!==null?U.x:0,mt=U!==null?U.y:0;kt.setTexture2D(A,0),F.copyTexSubImage2D(F.TEXTURE_2D,q,0,0,wt,mt,H,_t),yt.unbindTexture()},this.copyTextureToTexture=function(A,U,q=null,k=null,H=0,_t=0){let wt,mt,bt,Ct,zt,Yt,At,Zt,ye,ue=A.isCompressedTexture?A.mipmaps[_t]:A.image;if(q!==null)wt=q.max.x-q.min.x,mt=q.max.y-q.min.y,bt=q.isBox3?q.max.z-q.min.z:1,Ct=q.min.x,zt=q.min.y,Yt=q.isBox3?q.min.z:0;else{let te=Math.pow(2,-H);wt=Math.floor(ue.width*te),mt=Math.floor(ue.height*te),A.isDataArrayTexture?bt=ue.depth:A.isData3DTexture?bt=Math.floor(ue.depth*te):bt=1,Ct=0,zt=0,Yt=0}k!==null?(At=k.x,Zt=k.y,ye=k.z):(At=0,Zt=0,ye=0);let he=lt.convert(U.format),ze=lt.convert(U.type),Et;U.isData3DTexture?(kt.setTexture3D(U,0),Et=F.TEXTURE_3D):U.isDataArrayTexture||U.isCompressedArrayTexture?(kt.setTexture2DArray(U,0),Et=F.TEXTURE_2D_ARRAY):(kt.setTexture2D(U,0),Et=F.TEXTURE_2D),yt.activeTexture(F.TEXTURE0),yt.pixelStorei(F.UNPACK_FLIP_Y_WEBGL,U.flipY),yt.pixelStorei(F.UNPACK_PREMULTIPLY_ALPHA_WEBGL,U.premultiplyAlpha),yt.pixelStorei(F.UNPACK_ALIGNMENT,U.unpackAlignment);let qe=yt.getParameter(F.UNPACK_ROW_LENGTH),ne=yt.getParameter(F.UNPACK_IMAGE_HEIGHT),ts=yt.getParameter(F.UNPACK_SKIP_PIXELS),Ve=yt.getParameter(F.UNPACK_SKIP_ROWS),_a=yt.getParameter(F.UNPACK_SKIP_IMAGES);yt.pixelStorei(F.UNPACK_ROW_LENGTH,ue.width),yt.pixelStorei(F.UNPACK_IMAGE_HEIGHT,ue.height),yt.pixelStorei(F.UNPACK_SKIP_PIXELS,Ct),yt.pixelStorei(F.UNPACK_SKIP_ROWS,zt),yt.pixelStorei(F.UNPACK_SKIP_IMAGES,Yt);let Ti=A.isDataArrayTexture||A.isData3DTexture,es=U.isDataArrayTexture||U.isData3DTexture;if(A.isDepthTexture){let te=Ut.get(A),Ie=Ut.get(U),Rn=Ut.get(te.__renderTarget),ge=Ut.get(Ie.__renderTarget);yt.bindFramebuffer(F.READ_FRAMEBUFFER,Rn.__webglFramebuffer),yt.bindFramebuffer(F.DRAW_FRAMEBUFFER,ge.__webglFramebuffer);for(let Te=0;Te<bt;Te++)Ti&&(F.framebufferTextureLayer(F.READ_FRAMEBUFFER,F.COLOR_ATTACHMENT0,Ut.get(A).__webglTexture,H,Yt+Te),F.framebufferTextureLayer(F.DRAW_FRAMEBUFFER,F.COLOR_ATTACHMENT0,Ut.get(U).__webglTexture,_t,ye+Te)),F.blitFramebuffer(Ct,zt,Ct+wt,zt+mt,At,Zt,At+wt,Zt+mt,F.DEPTH_BUFFER_BIT,F.NEAREST);yt.bindFramebuffer(F.READ_FRAMEBUFFER,null),yt.bindFramebuffer(F.DRAW_FRAMEBUFFER,null)}else if(H!==0||A.isRenderTargetTexture||Ut.has(A)){let te=Ut.get(A),Ie=Ut.get(U);yt.bindFramebuffer(F.READ_FRAMEBUFFER,C),yt.bindFramebuffer(F.DRAW_FRAMEBUFFER,z);for(let Rn=0;Rn<bt;Rn++)Ti?F.framebufferTextureLayer(F.READ_FRAMEBUFFER,F.COLOR_ATTACHMENT0,te.__webglTexture,H,Yt+Rn):F.framebufferTexture2D(F.READ_FRAMEBUFFER,F.COLOR_ATTACHMENT0,F.TEXTURE_2D,te.__webglTexture,H),es?F.framebufferTextureLayer(F.DRAW_FRAMEBUFFER,F.COLOR_ATTACHMENT0,Ie.__webglTexture,_t,ye+Rn):F.framebufferTexture2D(F.DRAW_FRAMEBUFFER,F.COLOR_ATTACHMENT0,F.TEXTURE_2D,Ie.__webglTexture,_t),H!==0?F.blitFramebuffer(Ct,zt,Ct+wt,zt+mt,At,Zt,At+wt,Zt+mt,F.COLOR_BUFFER_BIT,F.NEAREST):es?F.copyTexSubImage3D(Et,_t,At,Zt,ye+Rn,Ct,zt,wt,mt):F.copyTexSubImage2D(Et,_t,At,Zt,Ct,zt,wt,mt);yt.bindFramebuffer(F.READ_FRAMEBUFFER,null),yt.bindFramebuffer(F.DRAW_FRAMEBUFFER,null)}else es?A.isDataTexture||A.isData3DTexture?F.texSubImage3D(Et,_t,At,Zt,ye,wt,mt,bt,he,ze,ue.data):U.isCompressedArrayTexture?F.compressedTexSubImage3D(Et,_t,At,Zt,ye,wt,mt,bt,he,ue.data):F.texSubImage3D(Et,_t,At,Zt,ye,wt,mt,bt,he,ze,ue):A.isDataTexture?F.texSubImage2D(F.TEXTURE_2D,_t,At,Zt,wt,mt,he,ze,ue.data):A.isCompressedTexture?F.compressedTexSubImage2D(F.TEXTURE_2D,_t,At,Zt,ue.width,ue.height,he,ue.data):F.texSubImage2D(F.TEXTURE_2D,_t,At,Zt,wt,mt,he,ze,ue);yt.pixelStorei(F.UNPACK_ROW_LENGTH,qe),yt.pixelStorei(F.UNPACK_IMAGE_HEIGHT,ne),yt.pixelStorei(F.UNPACK_SKIP_PIXELS,ts),yt.pixelStorei(F.UNPACK_SKIP_ROWS,Ve),yt.pixelStorei(F.UNPACK_SKIP_IMAGES,_a),_t===0&&U.generateMipmaps===!0&&U.mipmapsAutoUpdate===!0&&F.generateMipmap(Et),yt.unbindTexture()},this.initRenderTarget=function(A){Ut.get(A).__webglFramebuffer===void 0&&kt.setupRenderTarget(A)},this.initTexture=function(A){A.isCubeTexture?kt.setTextureCube(A,0):A.isData3DTexture?kt.setTexture3D(A,0):A.isDataArrayTexture||A.isCompressedArrayTexture?kt.setTexture2DArray(A,0):kt.setTexture2D(A,0),yt.unbindTexture()},this.resetState=function(){$=0,G=0,st=null,yt.reset(),ft.reset()},typeof __THREE_DEVTOOLS__<"u"&&__THREE_DEVTOOLS__.dispatchEvent(new CustomEvent("observe",{detail:this}))}get coordinateSystem(){return wn}get outputColorSpace(){return this._outputColorSpace}set outputColorSpace(t){this._outputColorSpace=t;let e=this.getContext();e.drawingBufferColorSpace=Jt._getDrawingBufferColorSpace(t),e.unpackColorSpace=Jt._getUnpackColorSpace()}};var zA={white:"#f4f1e8",yellow:"#f0c43c",red:"#c63a32",blue:"#3569b0",green:"#2f8559",black:"#33353a",pink:"#dd8fa6",brown:"#8a5a3a"},y_=["#f4f1e8","#c63a32","#f0c43c","#3569b0","#2f8559","#d9822b","#7d4fa0","#8a5a3a","#dd8fa6","#4aa3a2"],ji=(n,t)=>zA[(n.name??"").toLowerCase().split(" ")[0]]??y_[t%y_.length];function VA(n,t){let e=document.createElement("canvas");e.width=256,e.height=128;let i=e.getContext("2d");i.fillStyle=n,i.fillRect(0,0,256,128),i.fillStyle=t;let s=(o,a)=>{i.beginPath(),i.ellipse(o,a,12/Math.max(Math.sin(a/128*Math.PI),.05),12,0,0,7),i.fill()};for(let o of[32,96,160,224])s(o,64);i.fillRect(0,0,256,12),i.fillRect(0,116,256,12);let r=new Tr(e);return r.colorSpace=Ze,r}var pd=null;function GA(){if(pd)return pd;let n=document.createElement("canvas");n.width=n.height=128;let t=n.getContext("2d"),e=t.createRadialGradient(64,64,20,64,64,64);return e.addColorStop(0,"rgba(0,0,0,1)"),e.addColorStop(.55,"rgba(0,0,0,0.75)"),e.addColorStop(1,"rgba(0,0,0,0)"),t.fillStyle=e,t.fillRect(0,0,128,128),pd=new Tr(n)}var HA=new Cs(1,40,20).rotateX(Math.PI/2),WA=new Io(1,32),XA=new vi(1.16,1.34,48),ch=class{constructor(t,e,{ghost:i=!1,halo:s=null,floor:r,dark:o}){this.radius=1,this.group=new Le;let a=VA(t,e),c=new Rs({map:a,transparent:i,opacity:i?.55:1,depthWrite:!0});if(this.ball=new de(HA,c),this.group.add(this.ball),this.shadow=null,r){let l=new fn({map:GA(),transparent:!0,opacity:(o?.75:.42)*(i?.5:1),depthWrite:!1});this.shadow=new de(WA,l),this.group.add(this.shadow)}this.halo=null,s&&r&&(this.halo=new de(XA,new fn({color:new Gt(s),transparent:!0,opacity:i?.8:1,depthWrite:!1})),this.group.add(this.halo))}resize(t){this.radius=t,this.ball.scale.setScalar(t),this.halo?.scale.setScalar(t)}place(t,e,i){if(this.group.visible=i>.02*this.radius,!this.group.visible)return;i<1/0&&(this.ball.material.opacity=.6*Math.min(1,i/this.radius)),this.ball.position.set(t[0],t[1],t[2]),this.ball.quaternion.set(e[1],e[2],e[3],e[0]);let s=Math.max(0,t[2]-this.radius);this.shadow&&(this.shadow.position.set(t[0]-.5*s-.06*this.radius,t[1]+1.4*s+.14*this.radius,.004*this.radius),this.shadow.scale.setScalar(this.radius*(1.12+Math.min(1,.25*s/this.radius)))),this.halo&&this.halo.position.set(t[0],t[1],.008*this.radius)}};function hh(n){let t=!1;return()=>{t||(t=!0,requestAnimationFrame(()=>{t=!1,n()}))}}var Us=1e-6,[fh,md,$A,qA]=[0,2,3,4],[v_,uh,YA,ZA]=[4,6,8,17];function b_(n,t,e,i){let s=Math.max(8,Math.ceil(Math.abs(i-e)/4));return Array.from({length:s+1},(r,o)=>{let a=(e+(i-e)*o/s)*Math.PI/180;return[n[0]+t*Math.cos(a),n[1]+t*Math.sin(a)]})}var M_=n=>n.kind===fh&&n.R===0&&[n.lo1,n.hi1,n.lo2,n.hi2].every(t=>!Number.isFinite(t));function JA({p:n,d:t,...e},i,s,r){let o=Math.hypot(t[0],t[1]);if(o<Us)return[];let[a,c]=[t[0]/o,t[1]/o],l=((n[0]-s[0])*t[0]+(n[1]-s[1])*t[1]+n[2]*t[2])/o,[h,u]=[s[0]+l*a,s[1]+l*c],[f,d]=[-1/0,1/0];for(let{p:_,d:p}of i){if(Math.hypot(p[0],p[1])<Us)continue;let g=(h-_[0])*p[0]+(u-_[1])*p[1]-_[2]*p[2],x=-c*p[0]+a*p[1];x>Us?f=Math.max(f,-g/x):x<-Us&&(d=Math.min(d,-g/x))}return f>=d?[]:[{points:[Math.max(f,-r),Math.min(d,r)].map(_=>[h-_*c,u+_*a]),face:{p:n,d:t,...e},open:!Number.isFinite(f+d)}]}var jA=({p:n,u:t,rows:e=[]})=>e.slice(1,-1).flatMap(i=>[-1,-.5,0,.5,1].map(s=>{let[r,o]=[i[YA]*(1+s),i.slice(ZA).reduceRight((l,h)=>l*s+h,0)],[a,c]=[i[v_]+i[uh]*r-i[uh+1]*o,i[v_+1]+i[uh+1]*r+i[uh]*o];return[n[0]+t[0]*a-t[1]*c,n[1]+t[1]*a+t[0]*c]}));function KA(n,t,e,i){let{kind:s,p:r,d:o,R:a,u:c}=n,[l,h]=r;if(n.rows)return[{points:jA(n),face:null,open:!1}];if(s===$A&&a>0)return[{points:b_([l,h],a,0,360),face:null,open:!1}];if(s===fh&&M_(n))return JA(n,t.filter(f=>f!==n&&M_(f)),e,i);if(s===fh&&a===0){if(Math.abs(o[2])>1-Us)return[];let f=Math.abs(c[2])<.5?c:[o[1]*c[2]-o[2]*c[1],o[2]*c[0]-o[0]*c[2]],d=Math.abs(c[2])<.5?[n.lo1,n.hi1]:[n.lo2,n.hi2];return[{points:d.map(_=>Number.isFinite(_)?_:Math.sign(_)*2*i).map(_=>[l+_*f[0],h+_*f[1]]),face:n,open:!d.every(Number.isFinite)}]}let u=Math.abs(o[2])>1-Us;if(a>0&&(s===md||s===qA&&!t.some(f=>f.kind===md&&f.R>0))){let[f,d]=u&&n.lo1>-1?[Math.atan2(c[1],c[0])*180/Math.PI,Math.acos(n.lo1)*180/Math.PI]:[180,180];return[{points:b_([l,h],a,f-d,f+d),face:null,open:!u&&!Number.isFinite(n.hi2)}]}return s===md&&a===0&&Math.abs(o[2])<Us&&Number.isFinite(n.hi2)&&!t.some(f=>f.kind===fh)?[{points:[n.lo2,n.hi2].map(f=>[l+f*o[0],h+f*o[1]]),face:null,open:!1}]:[]}var Ai=(n,t,e)=>Math.abs(n[0]-t[0])<=e&&Math.abs(n[1]-t[1])<=e;function QA(n,t){let e=[...n],i=[];for(let s=e.shift();s!==void 0;s=e.shift()){let r=[s];for(let o=!0;o;){let[a,c]=[r[0].points[0],r[r.length-1].points.at(-1)];o=!1;for(let[l,h]of e.entries()){let[u,f]=[h.points[0],h.points.at(-1)],d={...h,points:[...h.points].reverse()};if(Ai(u,c,t))r.push(h);else if(Ai(f,c,t))r.push(d);else if(Ai(f,a,t))r.unshift(h);else if(Ai(u,a,t))r.unshift(d);else continue;e.splice(l,1),o=!0;break}}i.push(r)}return i}function fa(n,t,e){let i=Ii(n),s=i.flatMap(c=>KA(c,i,t,e)),o=1e-6*Math.max(...s.filter(({open:c})=>!c).flatMap(({points:[c,l]})=>[Math.abs(l[0]-c[0]),Math.abs(l[1]-c[1])]),1e-30),a=s.filter(({points:c},l)=>{let[h,u,f]=[c[0],c.at(-1),c[c.length>>1]];return!s.slice(0,l).some(({points:d})=>{let[m,_]=[d[0],d.at(-1)];return d.length===c.length&&(Ai(h,m,o)&&Ai(u,_,o)&&Ai(f,d[c.length>>1],o)||c.length===2&&Ai(h,_,o)&&Ai(u,m,o))})});return QA(a,o)}var dh=n=>n.flatMap(({points:t},e)=>e===0?t:t.slice(1));var w_=[{name:"free",label:"3-D"},{name:"above",label:"Above"},{name:"side",label:"Side"},{name:"along",label:"Along the wall"}],tE=1e4,eE=n=>tE*Math.max(1,...n.balls.flatMap(({position:t,radius:e})=>[...t.map(Math.abs),e])),ph=2.2;function mh(n,t){let e=Cn(t)/150,[i,s]=[1/0,1/0];return n.filter(r=>Math.hypot(r[1]-i,r[2]-s)>e&&([,i,s]=r))}var zr=n=>.16*Cn(n.box)/Math.max(1,Math.hypot(...n.scene.balls[n.ball].velocity)/2||1),Cn=({low:n,high:t})=>Math.max(t[0]-n[0],t[1]-n[1],1e-30),Vr=({low:n,high:t})=>[(n[0]+t[0])/2,(n[1]+t[1])/2,(n[2]+t[2])/2];function da(n,t){let[e,i]=Vr(t);return fa(n,[e,i],1.2*Cn(t)).map(dh)}function A_(n){let t=n.corner??n.center.map((e,i)=>e-n.size[i]/2);return[t,t.map((e,i)=>e+n.size[i])]}var S_=(n,t)=>{let e=fa(n,[0,0],t).flat();return e.length>0&&e.every(({points:i,open:s})=>!s&&i.some(r=>r.every(o=>Math.abs(o)<t)))},gd=n=>Math.max(...n.balls.map(t=>t.radius)),nE=(n,t)=>n.shape==="table"?ph*gd(t):0;function pa(n,t,e,i){let s=eE(n),r=[1/0,1/0,n.floor?0:1/0],o=[-1/0,-1/0,-1/0],a=(d,m=0)=>{for(let _=0;_<d.length;_++)Math.abs(d[_])>s||(r[_]=Math.min(r[_],d[_]-m),o[_]=Math.max(o[_],d[_]+m))},c={low:[0,0,0],high:[0,0,0]},l=n.walls.some(d=>S_(d,s)&&d.shape!=="segment");for(let d of n.walls)if(S_(d,s))for(let m of da(d,c))for(let _ of m)a(_,nE(d,n));n.balls.forEach(d=>a(d.position,d.radius));let h=d=>d.map((m,_)=>Math.max(r[_]-u,Math.min(o[_]+u,m))),u=1/0;for(let d of new Set([e,...t.keys()])){let m=t.get(d);m?.balls.forEach(({pieces:_},p)=>{let g=n.balls[p].radius,[x,b]=n.balls[p].position;for(let{points:v}of Qs(_,i,g))for(let w of v)a(l?[x,b,w[2]]:u<1/0?h(w):w,g)}),m&&u===1/0&&(u=.25*Math.max(o[0]-r[0],o[1]-r[1]))}let f=10*gd(n);for(let d of[0,1]){let m=(f-(o[d]-r[d]))/2;m>0&&(r[d]-=m,o[d]+=m)}return{low:r,high:o}}function ma(n,t,e){let i=gd(t),s=hs(n.low??"-inf"),r=hs(n.height??"inf"),o=t.floor?0:Math.min(e.low[2],-i),a=Math.max(o+1.7*i,Math.min(e.high[2],o+8*i));return[Math.max(s,o),Math.min(r,a)]}var iE={rolling:[],sliding:[7,4],flight:[1.5,3.5]},E_=24,T_=1.8;function C_(n,t){let e=document.createElement("canvas");e.tabIndex=0,e.setAttribute("role","img"),n.prepend(e);let i=null,s=null,r=0,o=hh(_),a=null,c=[0,0],l=1,h=[];function u(p){let[g,x]=[n.clientWidth,n.clientHeight],{low:b,high:v}=p.box,w=Math.min(.3*x,150),E=Math.min((g-40)/(v[0]-b[0]),(x-w-50)/(v[1]-b[1])),[y,M]=[(b[0]+v[0])/2,(b[1]+v[1])/2],L=Math.max(v[2]-b[2],1e-30),R=Math.min(E,(w-50)/L);return{width:g,height:x,k:E,up:R,strip:w,above:(D,N)=>[g/2+E*(D-y),(x-w)/2-E*(N-M)],side:(D,N)=>[g/2+E*(D-y),x-34-R*(N-b[2])],metres:(D,N)=>[y+(D-g/2)/E,M-(N-(x-w)/2)/E]}}function f(){if(!i)return[0,0];let{position:p,velocity:g,radius:x}=i.scene.balls[i.ball],b=Math.hypot(g[0],g[1]),v=b>0?[g[0]/b,g[1]/b]:[1,0],w=T_*x+b*l;return[p[0]+v[0]*w,p[1]+v[1]*w]}e.addEventListener("pointerdown",p=>{if(!i||t===null||p.button!==0)return;let g=u(i),x=i.scene.balls[i.ball],b=y=>Math.hypot(y[0]-p.offsetX,y[1]-p.offsetY),v=f();if(b(g.above(v[0],v[1]))<E_)a="velocity";else if(b(g.above(x.position[0],x.position[1]))<Math.max(E_,g.k*x.radius))a="ball";else return;let w=g.metres(p.offsetX,p.offsetY),E=a==="ball"?x.position:v;c=[E[0]-w[0],E[1]-w[1]],e.setPointerCapture(p.pointerId),t.start()}),e.addEventListener("pointermove",p=>{if(!a||!i||t===null)return;let[g,x]=u(i).metres(p.offsetX,p.offsetY).map((y,M)=>y+c[M]);if(a==="ball"){t.ball(g,x);return}let{position:b,radius:v}=i.scene.balls[i.ball],w=Math.hypot(g-b[0],x-b[1]),E=Math.max(0,w-T_*v)/l;t.velocity(E*(g-b[0])/(w||1),E*(x-b[1])/(w||1))});let d=()=>{a&&(a=null,i&&(l=zr(i)),t?.end(),o())};e.addEventListener("pointerup",d),e.addEventListener("pointercancel",d);function m(p,g){i=p,s=g,a||(l=zr(p)),h=[];for(let[x,b]of p.runs)b.balls.forEach(({pieces:v},w)=>{(x===p.followed||w===p.ball)&&h.push({law:x,ball:w,turns:new Ui(v)})});o()}function _(){if(!i||!s)return;let p=u(i),g=Math.min(devicePixelRatio,2);(e.width!==Math.round(p.width*g)||e.height!==Math.round(p.height*g))&&(e.width=Math.round(p.width*g),e.height=Math.round(p.height*g),e.style.width=`${p.width}px`,e.style.height=`${p.height}px`);let x=e.getContext("2d");x.setTransform(g,0,0,g,0,0),x.fillStyle=s.background,x.fillRect(0,0,p.width,p.height),x.strokeStyle=s.edge,x.lineWidth=2;for(let y of i.scene.walls)for(let M of da(y,i.box))x.beginPath(),M.forEach(([L,R])=>x.lineTo(...Ki(p.above(L,R)))),x.stroke();x.fillStyle=s.edge;for(let y of i.scene.walls)for(let{center:M,radius:L}of os(y))x.beginPath(),x.arc(...Ki(p.above(...M)),p.k*L,0,7),x.fill();if(x.fillStyle=s.floor,x.fillRect(0,p.height-p.strip,p.width,p.strip),x.fillStyle=s.soft,x.font="12px system-ui, sans-serif",x.fillText("from above",12,20),x.fillText(p.up<p.k*.99?"from the side (heights reduced)":"from the side",12,p.height-p.strip+18),i.scene.floor){x.strokeStyle=s.edge,x.beginPath();let y=p.side(i.box.low[0],0)[1];x.moveTo(0,y),x.lineTo(p.width,y),x.stroke()}for(let{law:y,ball:M,turns:L}of h){x.strokeStyle=M===i.ball?i.colours.get(y)??s.ink:ji(i.scene.balls[M],M),x.lineWidth=y===i.followed&&M===i.ball?2.4:1.4;for(let{style:R,points:D}of Qs(L.pieces,i.span,i.scene.balls[M].radius)){x.setLineDash(iE[R]);for(let N of[B=>p.above(B[0],B[1]),B=>p.side(B[0],B[2])])x.beginPath(),D.forEach(B=>x.lineTo(...Ki(N(B)))),x.stroke()}x.setLineDash([])}x.fillStyle=s.ink,x.strokeStyle=s.ink;for(let[y,M]of i.film.entries()){for(let[,R,D]of mh(M,i.box)){let N=p.above(R,D);x.fillRect(N[0]-1,N[1]-1,2,2)}let L=tr(M,r);L&&(x.beginPath(),x.arc(...Ki(p.above(...L)),3+p.k*i.scene.balls[y].radius,0,7),x.stroke())}let b=f(),v=i.scene.balls[i.ball].position;t&&(x.strokeStyle=x.fillStyle=s.ink,x.lineWidth=2,x.beginPath(),x.moveTo(...Ki(p.above(v[0],v[1]))),x.lineTo(...Ki(p.above(b[0],b[1]))),x.stroke(),x.beginPath(),x.arc(...Ki(p.above(b[0],b[1])),5,0,7),x.fill()),[e.dataset.ball,e.dataset.arrow]=[v,b].map(y=>p.above(y[0],y[1]).map(Math.round).join());let w=i.runs.get(i.followed),E=w?Mn(w.balls[i.ball].pieces,r).x:null;for(let{law:y,ball:M,turns:L}of[...h].reverse()){let{x:R,phase:D}=Mn(L.pieces,r);if(D==="pocketed")continue;let N=y===i.followed;if(!N&&E&&Math.hypot(R[0]-E[0],R[1]-E[1],R[2]-E[2])<.02*i.scene.balls[M].radius)continue;let B=N?ji(i.scene.balls[M],M):i.colours.get(y)??s.ink,C=Math.max(3,p.k*i.scene.balls[M].radius),[z,$,G,st]=L.at(r),X=[1-2*(G*G+st*st),2*($*G+z*st),2*($*st-z*G)];for(let[Z,it,Mt,Dt]of[[p.above(R[0],R[1]),X[0],-X[1],X[2]],[p.side(R[0],R[2]),X[0],-X[2],-X[1]]])x.globalAlpha=N?1:.55,x.fillStyle=B,x.strokeStyle=s.edge,x.lineWidth=1,x.beginPath(),x.arc(...Ki(Z),C,0,7),x.fill(),x.stroke(),Dt>0&&(x.fillStyle=s.ink,x.beginPath(),x.arc(Z[0]+C*it,Z[1]+C*Mt,Math.max(1.2,.2*C),0,7),x.fill()),x.globalAlpha=1}}return{update:m,trace(p){i&&(i={...i,span:p})},draw(p){r=p,o()},look:()=>o(),resize:()=>o(),picture(){return _(),new Promise((p,g)=>e.toBlob(x=>x?p(x):g(new Error("The browser gave no picture.")),"image/png"))}}}var Ki=n=>[n[0],n[1]];var R_={type:"change"},xd={type:"start"},I_={type:"end"},gh=new gi,P_=new Je,sE=Math.cos(70*oa.DEG2RAD),Ae=new P,on=2*Math.PI,ie={NONE:-1,ROTATE:0,DOLLY:1,PAN:2,TOUCH_ROTATE:3,TOUCH_PAN:4,TOUCH_DOLLY_PAN:5,TOUCH_DOLLY_ROTATE:6},_d=1e-6,_h=class extends jo{constructor(t,e=null){super(t,e),this.state=ie.NONE,this.target=new P,this.cursor=new P,this.minDistance=0,this.maxDistance=1/0,this.minZoom=0,this.maxZoom=1/0,this.minTargetRadius=0,this.maxTargetRadius=1/0,this.minPolarAngle=0,this.maxPolarAngle=Math.PI,this.minAzimuthAngle=-1/0,this.maxAzimuthAngle=1/0,this.enableDamping=!1,this.dampingFactor=.05,this.enableZoom=!0,this.zoomSpeed=1,this.enableRotate=!0,this.rotateSpeed=1,this.keyRotateSpeed=1,this.enablePan=!0,this.panSpeed=1,this.screenSpacePanning=!0,this.keyPanSpeed=7,this.zoomToCursor=!1,this.autoRotate=!1,this.autoRotateSpeed=2,this.keys={LEFT:"ArrowLeft",UP:"ArrowUp",RIGHT:"ArrowRight",BOTTOM:"ArrowDown"},this.mouseButtons={LEFT:qi.ROTATE,MIDDLE:qi.DOLLY,RIGHT:qi.PAN},this.touches={ONE:Yi.ROTATE,TWO:Yi.DOLLY_PAN},this.target0=this.target.clone(),this.position0=this.object.position.clone(),this.zoom0=this.object.zoom,this._cursorStyle="auto",this._domElementKeyEvents=null,this._lastPosition=new P,this._lastQuaternion=new Ne,this._lastTargetPosition=new P,this._quat=new Ne().setFromUnitVectors(t.up,new P(0,1,0)),this._quatInverse=this._quat.clone().invert(),this._spherical=new Nr,this._sphericalDelta=new Nr,this._scale=1,this._panOffset=new P,this._rotateStart=new ht,this._rotateEnd=new ht,this._rotateDelta=new ht,this._panStart=new ht,this._panEnd=new ht,this._panDelta=new ht,this._dollyStart=new ht,this._dollyEnd=new ht,this._dollyDelta=new ht,this._dollyDirection=new P,this._mouse=new ht,this._performCursorZoom=!1,this._pointers=[],this._pointerPositions={},this._controlActive=!1,this._onPointerMove=oE.bind(this),this._onPointerDown=rE.bind(this),this._onPointerUp=aE.bind(this),this._onContextMenu=pE.bind(this),this._onMouseWheel=hE.bind(this),this._onKeyDown=uE.bind(this),this._onTouchStart=fE.bind(this),this._onTouchMove=dE.bind(this),this._onMouseDown=lE.bind(this),this._onMouseMove=cE.bind(this),this._interceptControlDown=mE.bind(this),this._interceptControlUp=gE.bind(this),this.domElement!==null&&this.connect(this.domElement),this.update()}set cursorStyle(t){this._cursorStyle=t,t==="grab"?this.domElement.style.cursor="grab":this.domElement.style.cursor="auto"}get cursorStyle(){return this._cursorStyle}connect(t){super.connect(t),this.domElement.addEventListener("pointerdown",this._onPointerDown),this.domElement.addEventListener("pointercancel",this._onPointerUp),this.domElement.addEventListener("contextmenu",this._onContextMenu),this.domElement.addEventListener("wheel",this._onMouseWheel,{passive:!1}),this.domElement.ownerDocument.addEventListener("keydown",this._interceptControlDown,{passive:!0,capture:!0}),this.domElement.style.touchAction="none"}disconnect(){this.state=ie.NONE,this.domElement.removeEventListener("pointerdown",this._onPointerDown),this.domElement.ownerDocument.removeEventListener("pointermove",this._onPointerMove),this.domElement.ownerDocument.removeEventListener("pointerup",this._onPointerUp),this.domElement.removeEventListener("pointercancel",this._onPointerUp),this.domElement.removeEventListener("wheel",this._onMouseWheel),this.domElement.removeEventListener("contextmenu",this._onContextMenu),this.stopListenToKeyEvents(),this.domElement.ownerDocument.removeEventListener("keydown",this._interceptControlDown,{capture:!0}),this.domElement.ownerDocument.removeEventListener("keyup",this._interceptControlUp,{capture:!0}),this._controlActive=!1,this._pointers.length=0,this._pointerPositions={},this.domElement.style.touchAction="",this.domElement.style.cursor="auto"}dispose(){this.disconnect()}getPolarAngle(){return this._spherical.phi}getAzimuthalAngle(){return this._spherical.theta}getDistance(){return this.object.position.distanceTo(this.target)}listenToKeyEvents(t){t.addEventListener("keydown",this._onKeyDown),this._domElementKeyEvents=t}stopListenToKeyEvents(){this._domElementKeyEvents!==null&&(this._domElementKeyEvents.removeEventListener("keydown",this._onKeyDown),this._domElementKeyEvents=null)}saveState(){this.target0.copy(this.target),this.position0.copy(this.object.position),this.zoom0=this.object.zoom}reset(){this.target.copy(this.target0),this.object.position.copy(this.position0),this.object.zoom=this.zoom0,this.object.updateProjectionMatrix(),this.dispatchEvent(R_),this.update(),this.state=ie.NONE}pan(t,e){this._pan(t,e),this.update()}dollyIn(t){this._dollyIn(t),this.update()}dollyOut(t){this._dollyOut(t),this.update()}rotateLeft(t){this._rotateLeft(t),this.update()}rotateUp(t){this._rotateUp(t),this.update()}update(t=null){let e=this.object.position;Ae.copy(e).sub(this.target),Ae.applyQuaternion(this._quat),this._spherical.setFromVector3(Ae),this.autoRotate&&this.state===ie.NONE&&this._rotateLeft(this._getAutoRotationAngle(t)),this.enableDamping?(this._spherical.theta+=this._sphericalDelta.theta*this.dampingFactor,this._spherical.phi+=this._sphericalDelta.phi*this.dampingFactor):(this._spherical.theta+=this._sphericalDelta.theta,this._spherical.phi+=this._sphericalDelta.phi);let i=this.minAzimuthAngle,s=this.maxAzimuthAngle;isFinite(i)&&isFinite(s)&&(i<-Math.PI?i+=on:i>Math.PI&&(i-=on),s<-Math.PI?s+=on:s>Math.PI&&(s-=on),i<=s?this._spherical.theta=Math.max(i,Math.min(s,this._spherical.theta)):this._spherical.theta=this._spherical.theta>(i+s)/2?Math.max(i,this._spherical.theta):Math.min(s,this._spherical.theta)),this._spherical.phi=Math.max(this.minPolarAngle,Math.min(this.maxPolarAngle,this._spherical.phi)),this._spherical.makeSafe(),this.enableDamping===!0?this.target.addScaledVector(this._panOffset,this.dampingFactor):this.target.add(this._panOffset),this.target.sub(this.cursor),this.target.clampLength(this.minTargetRadius,this.maxTargetRadius),this.target.add(this.cursor);let r=!1;if(this.zoomToCursor&&this._performCursorZoom||this.object.isOrthographicCamera)this._spherical.radius=this._clampDistance(this._spherical.radius);else{let o=this._spherical.radius;this._spherical.radius=this._clampDistance(this._spherical.radius*this._scale),r=o!=this._spherical.radius}if(Ae.setFromSpherical(this._spherical),Ae.applyQuaternion(this._quatInverse),e.copy(this.target).add(Ae),this.object.lookAt(this.target),this.enableDamping===!0?(this._sphericalDelta.theta*=1-this.dampingFactor,this._sphericalDelta.phi*=1-this.dampingFactor,this._panOffset.multiplyScalar(1-this.dampingFactor)):(this._sphericalDelta.set(0,0,0),this._panOffset.set(0,0,0)),this.zoomToCursor&&this._performCursorZoom){let o=null;if(this.object.isPerspectiveCamera){let a=Ae.length();o=this._clampDistance(a*this._scale);let c=a-o;this.object.position.addScaledVector(this._dollyDirection,c),this.object.updateMatrixWorld(),r=!!c}else if(this.object.isOrthographicCamera){let a=new P(this._mouse.x,this._mouse.y,0);a.unproject(this.object);let c=this.object.zoom;this.object.zoom=Math.max(this.minZoom,Math.min(this.maxZoom,this.object.zoom/this._scale)),this.object.updateProjectionMatrix(),r=c!==this.object.zoom;let l=new P(this._mouse.x,this._mouse.y,0);l.unproject(this.object),this.object.position.sub(l).add(a),this.object.updateMatrixWorld(),o=Ae.length()}else console.warn("WARNING: OrbitControls.js encountered an unknown camera type - zoom to cursor disabled."),this.zoomToCursor=!1;o!==null&&(this.screenSpacePanning?this.target.set(0,0,-1).transformDirection(this.object.matrix).multiplyScalar(o).add(this.object.position):(gh.origin.copy(this.object.position),gh.direction.set(0,0,-1).transformDirection(this.object.matrix),Math.abs(this.object.up.dot(gh.direction))<sE?this.object.lookAt(this.target):(P_.setFromNormalAndCoplanarPoint(this.object.up,this.target),gh.intersectPlane(P_,this.target))))}else if(this.object.isOrthographicCamera){let o=this.object.zoom;this.object.zoom=Math.max(this.minZoom,Math.min(this.maxZoom,this.object.zoom/this._scale)),o!==this.object.zoom&&(this.object.updateProjectionMatrix(),r=!0)}return this._scale=1,this._performCursorZoom=!1,r||this._lastPosition.distanceToSquared(this.object.position)>_d||8*(1-this._lastQuaternion.dot(this.object.quaternion))>_d||this._lastTargetPosition.distanceToSquared(this.target)>_d?(this.dispatchEvent(R_),this._lastPosition.copy(this.object.position),this._lastQuaternion.copy(this.object.quaternion),this._lastTargetPosition.copy(this.target),!0):!1}_getAutoRotationAngle(t){return t!==null?on/60*this.autoRotateSpeed*t:on/60/60*this.autoRotateSpeed}_getZoomScale(t){let e=Math.abs(t*.01);return Math.pow(.95,this.zoomSpeed*e)}_rotateLeft(t){this._sphericalDelta.theta-=t}_rotateUp(t){this._sphericalDelta.phi-=t}_panLeft(t,e){Ae.setFromMatrixColumn(e,0),Ae.multiplyScalar(-t),this._panOffset.add(Ae)}_panUp(t,e){this.screenSpacePanning===!0?Ae.setFromMatrixColumn(e,1):(Ae.setFromMatrixColumn(e,0),Ae.crossVectors(this.object.up,Ae)),Ae.multiplyScalar(t),this._panOffset.add(Ae)}_pan(t,e){let i=this.domElement;if(this.object.isPerspectiveCamera){let s=this.object.position;Ae.copy(s).sub(this.target);let r=Ae.length();r*=Math.tan(this.object.fov/2*Math.PI/180),this._panLeft(2*t*r/i.clientHeight,this.object.matrix),this._panUp(2*e*r/i.clientHeight,this.object.matrix)}else this.object.isOrthographicCamera?(this._panLeft(t*(this.object.right-this.object.left)/this.object.zoom/i.clientWidth,this.object.matrix),this._panUp(e*(this.object.top-this.object.bottom)/this.object.zoom/i.clientHeight,this.object.matrix)):(console.warn("WARNING: OrbitControls.js encountered an unknown camera type - pan disabled."),this.enablePan=!1)}_dollyOut(t){this.object.isPerspectiveCamera||this.object.isOrthographicCamera?this._scale/=t:(console.warn("WARNING: OrbitControls.js encountered an unknown camera type - dolly/zoom disabled."),this.enableZoom=!1)}_dollyIn(t){this.object.isPerspectiveCamera||this.object.isOrthographicCamera?this._scale*=t:(console.warn("WARNING: OrbitControls.js encountered an unknown camera type - dolly/zoom disabled."),this.enableZoom=!1)}_updateZoomParameters(t,e){if(!this.zoomToCursor)return;this._performCursorZoom=!0;let i=this.domElement.getBoundingClientRect(),s=t-i.left,r=e-i.top,o=i.width,a=i.height;this._mouse.x=s/o*2-1,this._mouse.y=-(r/a)*2+1,this._dollyDirection.set(this._mouse.x,this._mouse.y,1).unproject(this.object).sub(this.object.position).normalize()}_clampDistance(t){return Math.max(this.minDistance,Math.min(this.maxDistance,t))}_handleMouseDownRotate(t){this._rotateStart.set(t.clientX,t.clientY)}_handleMouseDownDolly(t){this._updateZoomParameters(t.clientX,t.clientY),this._dollyStart.set(t.clientX,t.clientY)}_handleMouseDownPan(t){this._panStart.set(t.clientX,t.clientY)}_handleMouseMoveRotate(t){this._rotateEnd.set(t.clientX,t.clientY),this._rotateDelta.subVectors(this._rotateEnd,this._rotateStart).multiplyScalar(this.rotateSpeed);let e=this.domElement;this._rotateLeft(on*this._rotateDelta.x/e.clientHeight),this._rotateUp(on*this._rotateDelta.y/e.clientHeight),this._rotateStart.copy(this._rotateEnd),this.update()}_handleMouseMoveDolly(t){this._dollyEnd.set(t.clientX,t.clientY),this._dollyDelta.subVectors(this._dollyEnd,this._dollyStart),this._dollyDelta.y>0?this._dollyOut(this._getZoomScale(this._dollyDelta.y)):this._dollyDelta.y<0&&this._dollyIn(this._getZoomScale(this._dollyDelta.y)),this._dollyStart.copy(this._dollyEnd),this.zoomToCursor&&(this._performCursorZoom=!0,this._dollyDirection.set(this._mouse.x,this._mouse.y,1).unproject(this.object).sub(this.object.position).normalize()),this.update()}_handleMouseMovePan(t){this._panEnd.set(t.clientX,t.clientY),this._panDelta.subVectors(this._panEnd,this._panStart).multiplyScalar(this.panSpeed),this._pan(this._panDelta.x,this._panDelta.y),this._panStart.copy(this._panEnd),this.update()}_handleMouseWheel(t){this._updateZoomParameters(t.clientX,t.clientY),t.deltaY<0?this._dollyIn(this._getZoomScale(t.deltaY)):t.deltaY>0&&this._dollyOut(this._getZoomScale(t.deltaY)),this.update()}_handleKeyDown(t){let e=!1;switch(t.code){case this.keys.UP:t.ctrlKey||t.metaKey||t.shiftKey?this.enableRotate&&this._rotateUp(on*this.keyRotateSpeed/this.domElement.clientHeight):this.enablePan&&this._pan(0,this.keyPanSpeed),e=!0;break;case this.keys.BOTTOM:t.ctrlKey||t.metaKey||t.shiftKey?this.enableRotate&&this._rotateUp(-on*this.keyRotateSpeed/this.domElement.clientHeight):this.enablePan&&this._pan(0,-this.keyPanSpeed),e=!0;break;case this.keys.LEFT:t.ctrlKey||t.metaKey||t.shiftKey?this.enableRotate&&this._rotateLeft(on*this.keyRotateSpeed/this.domElement.clientHeight):this.enablePan&&this._pan(this.keyPanSpeed,0),e=!0;break;case this.keys.RIGHT:t.ctrlKey||t.metaKey||t.shiftKey?this.enableRotate&&this._rotateLeft(-on*this.keyRotateSpeed/this.domElement.clientHeight):this.enablePan&&this._pan(-this.keyPanSpeed,0),e=!0;break}e&&(t.preventDefault(),this.update())}_handleTouchStartRotate(t){if(this._pointers.length===1)this._rotateStart.set(t.pageX,t.pageY);else{let e=this._getSecondPointerPosition(t),i=.5*(t.pageX+e.x),s=.5*(t.pageY+e.y);this._rotateStart.set(i,s)}}_handleTouchStartPan(t){if(this._pointers.length===1)this._panStart.set(t.pageX,t.pageY);else{let e=this._getSecondPointerPosition(t),i=.5*(t.pageX+e.x),s=.5*(t.pageY+e.y);this._panStart.set(i,s)}}_handleTouchStartDolly(t){let e=this._getSecondPointerPosition(t),i=t.pageX-e.x,s=t.pageY-e.y,r=Math.sqrt(i*i+s*s);this._dollyStart.set(0,r)}_handleTouchStartDollyPan(t){this.enableZoom&&this._handleTouchStartDolly(t),this.enablePan&&this._handleTouchStartPan(t)}_handleTouchStartDollyRotate(t){this.enableZoom&&this._handleTouchStartDolly(t),this.enableRotate&&this._handleTouchStartRotate(t)}_handleTouchMoveRotate(t){if(this._pointers.length==1)this._rotateEnd.set(t.pageX,t.pageY);else{let i=this._getSecondPointerPosition(t),s=.5*(t.pageX+i.x),r=.5*(t.pageY+i.y);this._rotateEnd.set(s,r)}this._rotateDelta.subVectors(this._rotateEnd,this._rotateStart).multiplyScalar(this.rotateSpeed);let e=this.domElement;this._rotateLeft(on*this._rotateDelta.x/e.clientHeight),this._rotateUp(on*this._rotateDelta.y/e.clientHeight),this._rotateStart.copy(this._rotateEnd)}_handleTouchMovePan(t){if(this._pointers.length===1)this._panEnd.set(t.pageX,t.pageY);else{let e=this._getSecondPointerPosition(t),i=.5*(t.pageX+e.x),s=.5*(t.pageY+e.y);this._panEnd.set(i,s)}this._panDelta.subVectors(this._panEnd,this._panStart).multiplyScalar(this.panSpeed),this._pan(this._panDelta.x,this._panDelta.y),this._panStart.copy(this._panEnd)}_handleTouchMoveDolly(t){let e=this._getSecondPointerPosition(t),i=t.pageX-e.x,s=t.pageY-e.y,r=Math.sqrt(i*i+s*s);this._dollyEnd.set(0,r),this._dollyDelta.set(0,Math.pow(this._dollyEnd.y/this._dollyStart.y,this.zoomSpeed)),this._dollyOut(this._dollyDelta.y),this._dollyStart.copy(this._dollyEnd);let o=(t.pageX+e.x)*.5,a=(t.pageY+e.y)*.5;this._updateZoomParameters(o,a)}_handleTouchMoveDollyPan(t){this.enableZoom&&this._handleTouchMoveDolly(t),this.enablePan&&this._handleTouchMovePan(t)}_handleTouchMoveDollyRotate(t){this.enableZoom&&this._handleTouchMoveDolly(t),this.enableRotate&&this._handleTouchMoveRotate(t)}_addPointer(t){this._pointers.push(t.pointerId)}_removePointer(t){delete this._pointerPositions[t.pointerId];for(let e=0;e<this._pointers.length;e++)if(this._pointers[e]==t.pointerId){this._pointers.splice(e,1);return}}_isTrackingPointer(t){for(let e=0;e<this._pointers.length;e++)if(this._pointers[e]==t.pointerId)return!0;return!1}_trackPointer(t){let e=this._pointerPositions[t.pointerId];e===void 0&&(e=new ht,this._pointerPositions[t.pointerId]=e),e.set(t.pageX,t.pageY)}_getSecondPointerPosition(t){let e=t.pointerId===this._pointers[0]?this._pointers[1]:this._pointers[0];return this._pointerPositions[e]}_customWheelEvent(t){let e=t.deltaMode,i={clientX:t.clientX,clientY:t.clientY,deltaY:t.deltaY};switch(e){case 1:i.deltaY*=16;break;case 2:i.deltaY*=100;break}return t.ctrlKey&&!this._controlActive&&(i.deltaY*=10),i}};function rE(n){this.enabled!==!1&&(this._pointers.length===0&&(this.domElement.setPointerCapture(n.pointerId),this.domElement.ownerDocument.addEventListener("pointermove",this._onPointerMove),this.domElement.ownerDocument.addEventListener("pointerup",this._onPointerUp)),!this._isTrackingPointer(n)&&(this._addPointer(n),n.pointerType==="touch"?this._onTouchStart(n):this._onMouseDown(n),this._cursorStyle==="grab"&&(this.domElement.style.cursor="grabbing")))}function oE(n){this.enabled!==!1&&(n.pointerType==="touch"?this._onTouchMove(n):this._onMouseMove(n))}function aE(n){switch(this._removePointer(n),this._pointers.length){case 0:this.domElement.releasePointerCapture(n.pointerId),this.domElement.ownerDocument.removeEventListener("pointermove",this._onPointerMove),this.domElement.ownerDocument.removeEventListener("pointerup",this._onPointerUp),this.dispatchEvent(I_),this.state=ie.NONE,this._cursorStyle==="grab"&&(this.domElement.style.cursor="grab");break;case 1:let t=this._pointers[0],e=this._pointerPositions[t];this._onTouchStart({pointerId:t,pageX:e.x,pageY:e.y});break}}function lE(n){let t;switch(n.button){case 0:t=this.mouseButtons.LEFT;break;case 1:t=this.mouseButtons.MIDDLE;break;case 2:t=this.mouseButtons.RIGHT;break;default:t=-1}switch(t){case qi.DOLLY:if(this.enableZoom===!1)return;this._handleMouseDownDolly(n),this.state=ie.DOLLY;break;case qi.ROTATE:if(n.ctrlKey||n.metaKey||n.shiftKey){if(this.enablePan===!1)return;this._handleMouseDownPan(n),this.state=ie.PAN}else{if(this.enableRotate===!1)return;this._handleMouseDownRotate(n),this.state=ie.ROTATE}break;case qi.PAN:if(n.ctrlKey||n.metaKey||n.shiftKey){if(this.enableRotate===!1)return;this._handleMouseDownRotate(n),this.state=ie.ROTATE}else{if(this.enablePan===!1)return;this._handleMouseDownPan(n),this.state=ie.PAN}break;default:this.state=ie.NONE}this.state!==ie.NONE&&this.dispatchEvent(xd)}function cE(n){switch(this.state){case ie.ROTATE:if(this.enableRotate===!1)return;this._handleMouseMoveRotate(n);break;case ie.DOLLY:if(this.enableZoom===!1)return;this._handleMouseMoveDolly(n);break;case ie.PAN:if(this.enablePan===!1)return;this._handleMouseMovePan(n);break}}function hE(n){this.enabled===!1||this.enableZoom===!1||this.state!==ie.NONE||(n.preventDefault(),this.dispatchEvent(xd),this._handleMouseWheel(this._customWheelEvent(n)),this.dispatchEvent(I_))}function uE(n){this.enabled!==!1&&this._handleKeyDown(n)}function fE(n){switch(this._trackPointer(n),this._pointers.length){case 1:switch(this.touches.ONE){case Yi.ROTATE:if(this.enableRotate===!1){this.state=ie.NONE;break}this._handleTouchStartRotate(n),this.state=ie.TOUCH_ROTATE;break;case Yi.PAN:if(this.enablePan===!1){this.state=ie.NONE;break}this._handleTouchStartPan(n),this.state=ie.TOUCH_PAN;break;default:this.state=ie.NONE}break;case 2:switch(this.touches.TWO){case Yi.DOLLY_PAN:if(this.enableZoom===!1&&this.enablePan===!1)return;this._handleTouchStartDollyPan(n),this.state=ie.TOUCH_DOLLY_PAN;break;case Yi.DOLLY_ROTATE:if(this.enableZoom===!1&&this.enableRotate===!1)return;this._handleTouchStartDollyRotate(n),this.state=ie.TOUCH_DOLLY_ROTATE;break;default:this.state=ie.NONE}break;default:this.state=ie.NONE}this.state!==ie.NONE&&this.dispatchEvent(xd)}function dE(n){switch(this._trackPointer(n),this.state){case ie.TOUCH_ROTATE:if(this.enableRotate===!1)return;this._handleTouchMoveRotate(n),this.update();break;case ie.TOUCH_PAN:if(this.enablePan===!1)return;this._handleTouchMovePan(n),this.update();break;case ie.TOUCH_DOLLY_PAN:if(this.enableZoom===!1&&this.enablePan===!1)return;this._handleTouchMoveDollyPan(n),this.update();break;case ie.TOUCH_DOLLY_ROTATE:if(this.enableZoom===!1&&this.enableRotate===!1)return;this._handleTouchMoveDollyRotate(n),this.update();break;default:this.state=ie.NONE}}function pE(n){this.enabled!==!1&&n.preventDefault()}function mE(n){n.key==="Control"&&(this._controlActive=!0,this.domElement.ownerDocument.addEventListener("keyup",this._interceptControlUp,{passive:!0,capture:!0}))}function gE(n){n.key==="Control"&&(this._controlActive=!1,this.domElement.ownerDocument.removeEventListener("keyup",this._interceptControlUp,{passive:!0,capture:!0}))}xt.line={worldUnits:{value:1},linewidth:{value:1},resolution:{value:new ht},dashOffset:{value:0},dashScale:{value:1},dashSize:{value:1},gapSize:{value:1}};tn.line={uniforms:aa.merge([xt.common,xt.fog,xt.line]),vertexShader:`
		#include <common>
		#include <color_pars_vertex>
		#include <fog_pars_vertex>
		#include <logdepthbuf_pars_vertex>
		#include <clipping_planes_pars_vertex>

		uniform float linewidth;
		uniform vec2 resolution;

		attribute vec3 instanceStart;
		attribute vec3 instanceEnd;

		attribute vec3 instanceColorStart;
		attribute vec3 instanceColorEnd;

		#ifdef WORLD_UNITS

			varying vec4 worldPos;
			varying vec3 worldStart;
			varying vec3 worldEnd;

			#ifdef USE_DASH

				varying vec2 vUv;

			#endif

		#else

			varying vec2 vUv;

		#endif

		#ifdef USE_DASH

			uniform float dashScale;
			attribute float instanceDistanceStart;
			attribute float instanceDistanceEnd;
			varying float vLineDistance;

		#endif

		float trimSegmentAlpha( const in vec4 start, const in vec4 end ) {

			// compute the interpolation factor needed to trim the segment so it terminates
			// between the camera plane and the near plane

			// conservative estimate of the near plane
			float a = projectionMatrix[ 2 ][ 2 ]; // 3nd entry in 3th column
			float b = projectionMatrix[ 3 ][ 2 ]; // 3nd entry in 4th column

			// we need different nearEstimate formula for reversed and default depth buffer
			// a is positive with a reversed depth buffer so it can be used for controlling the code flow
			float nearEstimate = ( a > 0.0 ) ? ( - b / ( a + 1.0 ) ) : ( - 0.5 * b / a );

			return ( nearEstimate - start.z ) / ( end.z - start.z );

		}

		void main() {

			#ifdef USE_COLOR

				vColor.xyz = ( position.y < 0.5 ) ? instanceColorStart : instanceColorEnd;

			#endif

			float aspect = resolution.x / resolution.y;

			// camera space
			vec4 start = modelViewMatrix * vec4( instanceStart, 1.0 );
			vec4 end = modelViewMatrix * vec4( instanceEnd, 1.0 );

			#ifdef USE_DASH

				float lineDistanceStart = dashScale * instanceDistanceStart;
				float lineDistanceEnd = dashScale * instanceDistanceEnd;

			#endif

			#ifdef WORLD_UNITS

				worldStart = start.xyz;
				worldEnd = end.xyz;

			#else

				vUv = uv;

			#endif

			// special case for perspective projection, and segments that terminate either in, or behind, the camera plane
			// clearly the gpu firmware has a way of addressing this issue when projecting into ndc space
			// but we need to perform ndc-space calculations in the shader, so we must address this issue directly
			// perhaps there is a more elegant solution -- WestLangley

			bool perspective = ( projectionMatrix[ 2 ][ 3 ] == - 1.0 ); // 4th entry in the 3rd column

			if ( perspective ) {

				if ( start.z < 0.0 && end.z >= 0.0 ) {

					float alpha = trimSegmentAlpha( start, end );
					end.xyz = mix( start.xyz, end.xyz, alpha );

					#ifdef USE_DASH

						lineDistanceEnd = mix( lineDistanceStart, lineDistanceEnd, alpha );

					#endif

				} else if ( end.z < 0.0 && start.z >= 0.0 ) {

					float alpha = trimSegmentAlpha( end, start );
					start.xyz = mix( end.xyz, start.xyz, alpha );

					#ifdef USE_DASH

						lineDistanceStart = mix( lineDistanceEnd, lineDistanceStart, alpha );

					#endif

				}

			}

			#ifdef USE_DASH

				vLineDistance = ( position.y < 0.5 ) ? lineDistanceStart : lineDistanceEnd;
				vUv = uv;

			#endif

			// clip space
			vec4 clipStart = projectionMatrix * start;
			vec4 clipEnd = projectionMatrix * end;

			// ndc space
			vec3 ndcStart = clipStart.xyz / clipStart.w;
			vec3 ndcEnd = clipEnd.xyz / clipEnd.w;

			// direction
			vec2 dir = ndcEnd.xy - ndcStart.xy;

			// account for clip-space aspect ratio
			dir.x *= aspect;
			dir = normalize( dir );

			#ifdef WORLD_UNITS

				vec3 worldDir = normalize( end.xyz - start.xyz );
				vec3 tmpFwd = perspective ? normalize( mix( start.xyz, end.xyz, 0.5 ) ) : vec3( 0.0, 0.0, - 1.0 );
				vec3 worldUp = normalize( cross( worldDir, tmpFwd ) );
				vec3 worldFwd = cross( worldDir, worldUp );
				worldPos = position.y < 0.5 ? start: end;

				// height offset
				float hw = linewidth * 0.5;
				worldPos.xyz += position.x < 0.0 ? hw * worldUp : - hw * worldUp;

				// don't extend the line if we're rendering dashes because we
				// won't be rendering the endcaps
				#ifndef USE_DASH

					// cap extension
					worldPos.xyz += position.y < 0.5 ? - hw * worldDir : hw * worldDir;

					// add width to the box
					worldPos.xyz += worldFwd * hw;

					// endcaps
					if ( position.y > 1.0 || position.y < 0.0 ) {

						worldPos.xyz -= worldFwd * 2.0 * hw;

					}

				#endif

				// project the worldpos
				vec4 clip = projectionMatrix * worldPos;

				// shift the depth of the projected points so the line
				// segments overlap neatly
				vec3 clipPose = ( position.y < 0.5 ) ? ndcStart : ndcEnd;

				// only shift the depth of vertices in front of the camera (#35137)
				if ( clip.w > 0.0 ) clip.z = clipPose.z * clip.w;

			#else

				vec2 offset = vec2( dir.y, - dir.x );
				// undo aspect ratio adjustment
				dir.x /= aspect;
				offset.x /= aspect;

				// sign flip
				if ( position.x < 0.0 ) offset *= - 1.0;

				// endcaps
				if ( position.y < 0.0 ) {

					offset += - dir;

				} else if ( position.y > 1.0 ) {

					offset += dir;

				}

				// adjust for linewidth
				offset *= linewidth;

				// adjust for clip-space to screen-space conversion // maybe resolution should be based on viewport ...
				offset /= resolution.y;

				// select end
				vec4 clip = ( position.y < 0.5 ) ? clipStart : clipEnd;

				// back to clip space
				offset *= clip.w;

				clip.xy += offset;

			#endif

			gl_Position = clip;

			vec4 mvPosition = ( position.y < 0.5 ) ? start : end; // this is an approximation

			#include <logdepthbuf_vertex>
			#include <clipping_planes_vertex>
			#include <fog_vertex>

		}
		`,fragmentShader:`
		uniform vec3 diffuse;
		uniform float opacity;
		uniform float linewidth;

		#ifdef USE_DASH

			uniform float dashOffset;
			uniform float dashSize;
			uniform float gapSize;

		#endif

		varying float vLineDistance;

		#ifdef WORLD_UNITS

			varying vec4 worldPos;
			varying vec3 worldStart;
			varying vec3 worldEnd;

			#ifdef USE_DASH

				varying vec2 vUv;

			#endif

		#else

			varying vec2 vUv;

		#endif

		#include <common>
		#include <color_pars_fragment>
		#include <fog_pars_fragment>
		#include <logdepthbuf_pars_fragment>
		#include <clipping_planes_pars_fragment>

		vec2 closestLineToLine(vec3 p1, vec3 p2, vec3 p3, vec3 p4) {

			float mua;
			float mub;

			vec3 p13 = p1 - p3;
			vec3 p43 = p4 - p3;

			vec3 p21 = p2 - p1;

			float d1343 = dot( p13, p43 );
			float d4321 = dot( p43, p21 );
			float d1321 = dot( p13, p21 );
			float d4343 = dot( p43, p43 );
			float d2121 = dot( p21, p21 );

			float denom = d2121 * d4343 - d4321 * d4321;

			float numer = d1343 * d4321 - d1321 * d4343;

			mua = numer / denom;
			mua = clamp( mua, 0.0, 1.0 );
			mub = ( d1343 + d4321 * ( mua ) ) / d4343;
			mub = clamp( mub, 0.0, 1.0 );

			return vec2( mua, mub );

		}

		void main() {

			float alpha = opacity;
			vec4 diffuseColor = vec4( diffuse, alpha );

			#include <clipping_planes_fragment>

			#ifdef USE_DASH

				if ( vUv.y < - 1.0 || vUv.y > 1.0 ) discard; // discard endcaps

				if ( mod( vLineDistance + dashOffset, dashSize + gapSize ) > dashSize ) discard; // todo - FIX

			#endif

			#ifdef WORLD_UNITS

				float len;

				if ( isOrthographic ) {

					// View rays are parallel to the z axis so the distance reduces to camera-space XY
					vec2 lineDir = worldEnd.xy - worldStart.xy;
					float t = clamp( dot( worldPos.xy - worldStart.xy, lineDir ) / dot( lineDir, lineDir ), 0.0, 1.0 );
					len = length( worldStart.xy + lineDir * t - worldPos.xy );

				} else {

					// Find the closest points on the view ray and the line segment
					vec3 rayEnd = normalize( worldPos.xyz ) * 1e5;
					vec3 lineDir = worldEnd - worldStart;
					vec2 params = closestLineToLine( worldStart, worldEnd, vec3( 0.0, 0.0, 0.0 ), rayEnd );

					vec3 p1 = worldStart + lineDir * params.x;
					vec3 p2 = rayEnd * params.y;
					vec3 delta = p1 - p2;
					len = length( delta );

				}

				float norm = len / linewidth;

				#ifndef USE_DASH

					#ifdef USE_ALPHA_TO_COVERAGE

						float dnorm = fwidth( norm );
						alpha = 1.0 - smoothstep( 0.5 - dnorm, 0.5 + dnorm, norm );

					#else

						if ( norm > 0.5 ) {

							discard;

						}

					#endif

				#endif

			#else

				#ifdef USE_ALPHA_TO_COVERAGE

					// artifacts appear on some hardware if a derivative is taken within a conditional
					float a = vUv.x;
					float b = ( vUv.y > 0.0 ) ? vUv.y - 1.0 : vUv.y + 1.0;
					float len2 = a * a + b * b;
					float dlen = fwidth( len2 );

					if ( abs( vUv.y ) > 1.0 ) {

						alpha = 1.0 - smoothstep( 1.0 - dlen, 1.0 + dlen, len2 );

					}

				#else

					if ( abs( vUv.y ) > 1.0 ) {

						float a = vUv.x;
						float b = ( vUv.y > 0.0 ) ? vUv.y - 1.0 : vUv.y + 1.0;
						float len2 = a * a + b * b;

						if ( len2 > 1.0 ) discard;

					}

				#endif

			#endif

			#include <logdepthbuf_fragment>
			#include <color_fragment>

			gl_FragColor = vec4( diffuseColor.rgb, alpha );

			#include <tonemapping_fragment>
			#include <colorspace_fragment>
			#include <fog_fragment>
			#include <premultiplied_alpha_fragment>

		}
		`};var Gr=class extends En{constructor(t){super({type:"LineMaterial",uniforms:aa.clone(tn.line.uniforms),vertexShader:tn.line.vertexShader,fragmentShader:tn.line.fragmentShader,clipping:!0}),this.isLineMaterial=!0,this.setValues(t)}get color(){return this.uniforms.diffuse.value}set color(t){this.uniforms.diffuse.value=t}get worldUnits(){return"WORLD_UNITS"in this.defines}set worldUnits(t){t===!0!==this.worldUnits&&(this.needsUpdate=!0),t===!0?this.defines.WORLD_UNITS="":delete this.defines.WORLD_UNITS}get linewidth(){return this.uniforms.linewidth.value}set linewidth(t){this.uniforms.linewidth&&(this.uniforms.linewidth.value=t)}get dashed(){return"USE_DASH"in this.defines}set dashed(t){t===!0!==this.dashed&&(this.needsUpdate=!0),t===!0?this.defines.USE_DASH="":delete this.defines.USE_DASH}get dashScale(){return this.uniforms.dashScale.value}set dashScale(t){this.uniforms.dashScale.value=t}get dashSize(){return this.uniforms.dashSize.value}set dashSize(t){this.uniforms.dashSize.value=t}get dashOffset(){return this.uniforms.dashOffset.value}set dashOffset(t){this.uniforms.dashOffset.value=t}get gapSize(){return this.uniforms.gapSize.value}set gapSize(t){this.uniforms.gapSize.value=t}get opacity(){return this.uniforms.opacity.value}set opacity(t){this.uniforms&&(this.uniforms.opacity.value=t)}get resolution(){return this.uniforms.resolution.value}set resolution(t){this.uniforms.resolution.value.copy(t)}get alphaToCoverage(){return"USE_ALPHA_TO_COVERAGE"in this.defines}set alphaToCoverage(t){this.defines&&(t===!0!==this.alphaToCoverage&&(this.needsUpdate=!0),t===!0?this.defines.USE_ALPHA_TO_COVERAGE="":delete this.defines.USE_ALPHA_TO_COVERAGE)}};var L_=new un,xh=new P,Os=class extends Yo{constructor(){super(),this.isLineSegmentsGeometry=!0,this.type="LineSegmentsGeometry";let t=[-1,2,0,1,2,0,-1,1,0,1,1,0,-1,0,0,1,0,0,-1,-1,0,1,-1,0],e=[-1,2,1,2,-1,1,1,1,-1,-1,1,-1,-1,-2,1,-2],i=[0,2,1,2,3,1,2,4,3,4,5,3,4,6,5,6,7,5];this.setIndex(i),this.setAttribute("position",new Vt(t,3)),this.setAttribute("uv",new Vt(e,2))}applyMatrix4(t){let e=this.attributes.instanceStart,i=this.attributes.instanceEnd;return e!==void 0&&(e.applyMatrix4(t),i.applyMatrix4(t),e.needsUpdate=!0),this.boundingBox!==null&&this.computeBoundingBox(),this.boundingSphere!==null&&this.computeBoundingSphere(),this}setPositions(t){let e;t instanceof Float32Array?e=t:Array.isArray(t)&&(e=new Float32Array(t));let i=new $i(e,6,1);return this.setAttribute("instanceStart",new Bn(i,3,0)),this.setAttribute("instanceEnd",new Bn(i,3,3)),this.instanceCount=this.attributes.instanceStart.count,this.computeBoundingBox(),this.computeBoundingSphere(),this}setColors(t){let e;t instanceof Float32Array?e=t:Array.isArray(t)&&(e=new Float32Array(t));let i=new $i(e,6,1);return this.setAttribute("instanceColorStart",new Bn(i,3,0)),this.setAttribute("instanceColorEnd",new Bn(i,3,3)),this}fromWireframeGeometry(t){return this.setPositions(t.attributes.position.array),this}fromEdgesGeometry(t){return this.setPositions(t.attributes.position.array),this}fromMesh(t){return this.fromWireframeGeometry(new Vo(t.geometry)),this}fromLineSegments(t){let e=t.geometry;return this.setPositions(e.attributes.position.array),this}computeBoundingBox(){this.boundingBox===null&&(this.boundingBox=new un);let t=this.attributes.instanceStart,e=this.attributes.instanceEnd;t!==void 0&&e!==void 0&&(this.boundingBox.setFromBufferAttribute(t),L_.setFromBufferAttribute(e),this.boundingBox.union(L_))}computeBoundingSphere(){this.boundingSphere===null&&(this.boundingSphere=new An),this.boundingBox===null&&this.computeBoundingBox();let t=this.attributes.instanceStart,e=this.attributes.instanceEnd;if(t!==void 0&&e!==void 0){let i=this.boundingSphere.center;this.boundingBox.getCenter(i);let s=0;for(let r=0,o=t.count;r<o;r++)xh.fromBufferAttribute(t,r),s=Math.max(s,i.distanceToSquared(xh)),xh.fromBufferAttribute(e,r),s=Math.max(s,i.distanceToSquared(xh));this.boundingSphere.radius=Math.sqrt(s),isNaN(this.boundingSphere.radius)&&console.error("THREE.LineSegmentsGeometry.computeBoundingSphere(): Computed radius is NaN. The instanced position data is likely to have NaN values.",this)}}toJSON(){}};var yd=new oe,N_=new P,D_=new P,Oe=new oe,Fe=new oe,Kn=new oe,vd=new P,bd=new re,Be=new Jo,U_=new P,yh=new un,vh=new An,Qn=new oe,ti,Fs;function O_(n,t,e){return Qn.set(0,0,-t,1).applyMatrix4(n.projectionMatrix),Qn.multiplyScalar(1/Qn.w),Qn.x=Fs/e.width,Qn.y=Fs/e.height,Qn.applyMatrix4(n.projectionMatrixInverse),Qn.multiplyScalar(1/Qn.w),Math.abs(Math.max(Qn.x,Qn.y))}function _E(n,t){let e=n.matrixWorld,i=n.geometry,s=i.attributes.instanceStart,r=i.attributes.instanceEnd,o=Math.min(i.instanceCount,s.count);for(let a=0,c=o;a<c;a++){Be.start.fromBufferAttribute(s,a),Be.end.fromBufferAttribute(r,a),Be.applyMatrix4(e);let l=new P,h=new P;ti.distanceSqToSegment(Be.start,Be.end,h,l),h.distanceTo(l)<Fs*.5&&t.push({point:h,pointOnLine:l,distance:ti.origin.distanceTo(h),object:n,face:null,faceIndex:a,uv:null,uv1:null})}}function xE(n,t,e){let i=t.projectionMatrix,r=n.material.resolution,o=n.matrixWorld,a=n.geometry,c=a.attributes.instanceStart,l=a.attributes.instanceEnd,h=Math.min(a.instanceCount,c.count),u=-t.near;ti.at(1,Kn),Kn.w=1,Kn.applyMatrix4(t.matrixWorldInverse),Kn.applyMatrix4(i),Kn.multiplyScalar(1/Kn.w),Kn.x*=r.x/2,Kn.y*=r.y/2,Kn.z=0,vd.copy(Kn),bd.multiplyMatrices(t.matrixWorldInverse,o);for(let f=0,d=h;f<d;f++){if(Oe.fromBufferAttribute(c,f),Fe.fromBufferAttribute(l,f),Oe.w=1,Fe.w=1,Oe.applyMatrix4(bd),Fe.applyMatrix4(bd),Oe.z>u&&Fe.z>u)continue;if(Oe.z>u){let b=Oe.z-Fe.z,v=(Oe.z-u)/b;Oe.lerp(Fe,v)}else if(Fe.z>u){let b=Fe.z-Oe.z,v=(Fe.z-u)/b;Fe.lerp(Oe,v)}Oe.applyMatrix4(i),Fe.applyMatrix4(i),Oe.multiplyScalar(1/Oe.w),Fe.multiplyScalar(1/Fe.w),Oe.x*=r.x/2,Oe.y*=r.y/2,Fe.x*=r.x/2,Fe.y*=r.y/2,Be.start.copy(Oe),Be.start.z=0,Be.end.copy(Fe),Be.end.z=0;let _=Be.closestPointToPointParameter(vd,!0);Be.at(_,U_);let p=oa.lerp(Oe.z,Fe.z,_),g=p>=-1&&p<=1,x=vd.distanceTo(U_)<Fs*.5;if(g&&x){Be.start.fromBufferAttribute(c,f),Be.end.fromBufferAttribute(l,f),Be.start.applyMatrix4(o),Be.end.applyMatrix4(o);let b=new P,v=new P;ti.distanceSqToSegment(Be.start,Be.end,v,b),e.push({point:v,pointOnLine:b,distance:ti.origin.distanceTo(v),object:n,face:null,faceIndex:f,uv:null,uv1:null})}}}var Hr=class extends de{constructor(t=new Os,e=new Gr({color:Math.random()*16777215})){super(t,e),this.isLineSegments2=!0,this.type="LineSegments2"}computeLineDistances(){let t=this.geometry,e=t.attributes.instanceStart,i=t.attributes.instanceEnd,s=new Float32Array(2*e.count);for(let o=0,a=0,c=e.count;o<c;o++,a+=2)N_.fromBufferAttribute(e,o),D_.fromBufferAttribute(i,o),s[a]=a===0?0:s[a-1],s[a+1]=s[a]+N_.distanceTo(D_);let r=new $i(s,2,1);return t.setAttribute("instanceDistanceStart",new Bn(r,1,0)),t.setAttribute("instanceDistanceEnd",new Bn(r,1,1)),this}raycast(t,e){let i=this.material.worldUnits,s=t.camera;if(s===null&&!i&&console.error('LineSegments2: "Raycaster.camera" needs to be set in order to raycast against LineSegments2 while worldUnits is set to false.'),i===!1&&(this.material.resolution.x===0||this.material.resolution.y===0))return;let r=t.params.Line2!==void 0&&t.params.Line2.threshold||0;ti=t.ray;let o=this.matrixWorld,a=this.geometry,c=this.material;Fs=c.linewidth+r,a.boundingSphere===null&&a.computeBoundingSphere(),vh.copy(a.boundingSphere).applyMatrix4(o);let l;if(i)l=Fs*.5;else{let u=Math.max(s.near,vh.distanceToPoint(ti.origin));l=O_(s,u,c.resolution)}if(vh.radius+=l,ti.intersectsSphere(vh)===!1)return;a.boundingBox===null&&a.computeBoundingBox(),yh.copy(a.boundingBox).applyMatrix4(o);let h;if(i)h=Fs*.5;else{let u=Math.max(s.near,yh.distanceToPoint(ti.origin));h=O_(s,u,c.resolution)}yh.expandByScalar(h),ti.intersectsBox(yh)!==!1&&(i?_E(this,e):xE(this,s,e))}onBeforeRender(t){let e=this.material.uniforms;e&&e.resolution&&(t.getViewport(yd),this.material.uniforms.resolution.value.set(yd.z,yd.w))}};var F_={rolling:null,sliding:[1.5,.9],flight:[.28,.55]};function yE(n){let t=[];for(let e=0;e+1<n.length;e++)t.push(...n[e],...n[e+1]);return t}var vE=2,bE=new vi(1.05,1.3,48),bh=class{constructor(){this.group=new Le,this.lines=new Map,this.dots=[],this.pixels={width:1,height:1}}#t(t,e,i,s,r,o,a,c){let l=i==="thread",h=this.lines.get(t);h||(h=l?new _i(new ae,new Zn({transparent:!0,depthWrite:!1})):new Hr(new Os,new Gr({dashed:F_[i]!==null,transparent:!0,depthWrite:!1})),h.frustumCulled=!1,this.lines.set(t,h),this.group.add(h)),h.geometry.dispose();let u=h.material;if(u.color.set(s),u.opacity=o,h.renderOrder=c?3:2,h.visible=!0,h instanceof Hr){let f=F_[i];h.geometry=new Os().setPositions(e),h.material.linewidth=r,h.material.resolution.set(this.pixels.width,this.pixels.height),f&&(h.material.dashSize=f[0]*a,h.material.gapSize=f[1]*a,h.computeLineDistances())}else h.geometry=new ae,h.geometry.setAttribute("position",new Vt(e,3))}film(t,e){t.scene.balls.forEach(({radius:i},s)=>{let[r,o]=this.dots[s]??=this.#e();r.material.color.set(e),o.material.color.set(e),o.scale.setScalar(i),r.geometry.setAttribute("position",new Vt(mh(t.film[s]??[],t.box).flatMap(([,a,c])=>[a,c,i]),3))})}#e(){let t={transparent:!0,depthWrite:!1},e=new To(new ae,new Er({size:vE,sizeAttenuation:!1,...t})),i=new de(bE,new fn({...t,depthTest:!1}));return e.frustumCulled=!1,e.renderOrder=i.renderOrder=4,this.group.add(e,i),[e,i]}filmAt(t,e){this.dots.forEach(([,i],s)=>{let r=t.film[s]&&tr(t.film[s],e);i.visible=!!r,r&&i.position.set(...r,t.scene.balls[s].radius)})}update(t,e){for(let o of this.lines.values())o.visible=!1;let i=Cn(t.box)/100,s=t.scene.balls.length>6,r=t.scene.balls.length>60;for(let[o,a]of t.runs){let c=o===t.followed;a.balls.forEach(({pieces:l},h)=>{let u=h===t.ball;if(!u&&(!c||r))return;let f=(u?t.colours.get(o):null)??e(h),d={rolling:[],sliding:[],flight:[],thread:[]};for(let{style:m,points:_}of Qs(l,t.span,t.scene.balls[h].radius)){if(d[t.scene.floor?m:"rolling"].push(...yE(_)),m!=="flight"||!t.scene.floor||s)continue;let p=t.scene.balls[h].radius;for(let g of _)g[2]>p*1.001&&g[2]<5*p&&d.thread.push(...g,g[0],g[1],0)}for(let[m,_]of Object.entries(d)){if(!_.length)continue;let p=m==="thread"?.35:u?1:s?.45:.75;this.#t(`${o} ${h} ${m}`,_,m,f,u?c?3.4:2.4:1.4,p,i,c)}})}}resize(t,e){this.pixels={width:t,height:e};for(let i of this.lines.values())i instanceof Hr&&i.material.resolution.set(t,e)}};var ME="#0c0d0f";function Sd(n,t){let e=new ae;return e.setAttribute("position",new Vt(n,3)),e.setIndex(t),e.computeVertexNormals(),e}function B_(n,t,e){let i=[],s=[];for(let r of n)for(let o=0;o+1<r.length;o++){let a=i.length/3;i.push(...r[o],t,...r[o+1],t,...r[o+1],e,...r[o],e),s.push(a,a+1,a+2,a,a+2,a+3)}return Sd(i,s)}function wd(n,t){let e=[];for(let s of t)for(let r of n)for(let o=0;o+1<r.length;o++)e.push(...r[o],s,...r[o+1],s);let i=new ae;return i.setAttribute("position",new Vt(e,3)),i}function SE(n,t,e){let i=Math.max(...t.balls.map(p=>p.radius)),[,s]=ma(n,t,e),r=n.nose_height??null,o=Math.max(Math.min(s,1.7*i),r===null?0:r+.12*i),a=ph*i,c=r===null?[[0,0],[0,o],[a,o],[a,0]]:[[.55*i,0],[0,r],[.25*i,o],[a,o],[a,0]],[l,h]=n.center,u=[[-1,-1],[1,-1],[1,1],[-1,1],[-1,-1]].map(([p,g])=>c.map(([x,b])=>[l+p*(n.length/2+x),h+g*(n.width/2+x),b])),f=[],d=[];for(let p=0;p<4;p++)for(let g=0;g+1<c.length;g++){let x=f.length/3;f.push(...u[p][g],...u[p+1][g],...u[p+1][g+1],...u[p][g+1]),d.push(x,x+1,x+2,x,x+2,x+3)}let m=1,_=u.map(p=>[p[m][0],p[m][1]]);return{faces:Sd(f,d),lines:wd([_],[c[m][1]])}}function wE(n,t,e){let i=Math.max(...t.balls.map(u=>u.radius)),s=n.nose_height??i,r=Math.max(Math.min(ma(n,t,e)[1],1.7*i),s+.12*i),o=fa(n,[0,0],0),a=o.map(dh),c=({points:[u,f],face:d})=>d===null?-1:Math.hypot(f[0]-u[0],f[1]-u[1]),l=o.map((u,f)=>{let{face:d}=u.reduce((b,v)=>c(v)>c(b)?v:b),{p:m,d:_}=d,p=b=>-(b[0]-m[0])*_[0]-(b[1]-m[1])*_[1],g=Math.max(ph*i,...a[f].map(p)),x=[a[f][a[f].length-1],a[f][0]].map(b=>new ht(b[0]-(g-p(b))*_[0],b[1]-(g-p(b))*_[1]));return new As([...a[f].map(b=>new ht(...b)),...x])}),h=os(n).map(({center:u,radius:f})=>new As().absarc(u[0],u[1],f,0,2*Math.PI,!1));return[{faces:B_(a,0,r),lines:wd(a,[s,r])},{faces:new Ir(l).translate(0,0,r),lines:new ae},{faces:new Ir(h,24).translate(0,0,.06*i),lines:new ae,hole:!0}]}function Md(n,t,e,i,s){let r=Cn(i),o=Math.hypot(t[0],t[1]),a=Vr(i),c=(n[0]-a[0])*t[0]+(n[1]-a[1])*t[1]+(n[2]-a[2])*t[2],l=Pn(a,en(t,c));if(o<.05){let M=.62*r,L=l[2],R=-Math.sign(t[2])*.02*r;return new yi(2*M,2*M,Math.abs(R)).translate(a[0],a[1],L+R/2)}let h=vn([-t[1],t[0],0]),u=ba(t,h),f=u[2]<0?en(u,-1):u,[d,m]=ma({},e,i),_=M=>Pn(l,en(f,(M-l[2])/f[2])),p=.75*r,g=en(vn([t[0],t[1],0]),-.05*r),[x,b]=[_(d),_(m)],v=[Pn(x,en(h,-p)),Pn(x,en(h,p)),Pn(b,en(h,p)),Pn(b,en(h,-p))],w=v.map(M=>Pn(M,g)),E=s?[0,1,2,0,2,3,3,2,6,3,6,7,0,4,5,0,5,1,1,5,6,1,6,2,0,3,7,0,7,4]:[0,1,2,0,2,3],y=Sd([...v,...w].flat(),E).toNonIndexed();return y.computeVertexNormals(),y}function AE(n,t,e){let[i,s]=ma(n,t,e);switch(n.shape){case"table":return os(n).length>0?wE(n,t,e):[SE(n,t,e)];case"plane":{let r=vn(n.normal);return[{faces:Md(n.point,r,t,e,!0),clear:Math.hypot(r[0],r[1])<.05}]}case"strip":{let r=vn(n.normal),o=Pn(n.point,en(r,n.width)),a=Math.hypot(r[0],r[1])<.05;return[{faces:Md(n.point,r,t,e,!0),clear:a},{faces:Md(o,en(r,-1),t,e,!0),clear:a}]}case"box":{let[r,o]=A_(n),a=en(Pn(r,o),.5);return[{faces:new yi(...n.size).translate(...a),inside:n.inside}]}case"sphere":return[{faces:new Cs(n.radius,48,24).rotateX(Math.PI/2).translate(...n.center),inside:n.inside,lines:new ae}];case"cylinder":{let r=vn(n.axis),o=hs(n.height),a=Math.abs(r[2])>.99,c=Number.isFinite(o)?o:a?s-i:2*Cn(e),l=new Gi(n.radius,n.radius,c,64,1,n.inside);l.applyQuaternion(new Ne().setFromUnitVectors(new P(0,1,0),new P(...r)));let h=Number.isFinite(o)||a?0:-c/2,u=Number.isFinite(o)||!a?n.point:[n.point[0],n.point[1],r[2]>0?i:s];return[{faces:l.translate(...Pn(u,en(r,h+c/2))),inside:n.inside}]}default:{let r=da(n,e);return[{faces:B_(r,i,s),lines:wd(r,[i,s]),clear:!0}]}}}function k_(n,t,e){let i=new Le,s=new Zn({color:e.edge});for(let r of n.walls)for(let{faces:o,lines:a,inside:c,clear:l,hole:h}of AE(r,n,t)){let u=!!(l||c),f=new Rs({color:h?ME:e.wall,side:c?Ue:Tn,transparent:u,opacity:u?.3:1,depthWrite:!u,polygonOffset:!h,polygonOffsetFactor:1,polygonOffsetUnits:1});i.add(new de(o,f)),i.add(new _i(a??EE(o,Cn(t)),s))}return i}function EE(n,t){if(t>.01&&t<1e4)return new Cr(n,25);let e=n.clone().scale(1/t,1/t,1/t),i=new Cr(e,25).scale(t,t,t);return e.dispose(),i}function z_(n){n.traverse(t=>{t.geometry?.dispose();for(let e of[t.material].flat())e?.dispose()})}var V_=26,G_=1.8;function H_(n){let t=10**Math.floor(Math.log10(n)),e=n/t;return(e>=5?5:e>=2?2:1)*t}function TE(n){let[t,e]=[[1e3,"km"],[1,"m"],[.001,"mm"],[1e-6,"\xB5m"],[1e-9,"nm"]].find(([i])=>n>=Number(i)*.999999999)??[1e-9,"nm"];return`${Number((n/t).toPrecision(1))} ${e}`}function CE(){let n=document.createElement("canvas").getContext("webgl2"),t=n?.getExtension("WEBGL_debug_renderer_info"),e=n&&t?String(n.getParameter(t.UNMASKED_RENDERER_WEBGL)):"";return n?.getExtension("WEBGL_lose_context")?.loseContext(),/swiftshader|llvmpipe|software|basic render/i.test(e)}function W_(n,t,e){let i=new oh({antialias:!CE(),alpha:!1,powerPreference:"low-power"}),s=i.domElement;s.tabIndex=0,s.setAttribute("role","img"),n.prepend(s);let r=new wo,o=new je(30,1,.01,100);o.up.set(0,0,1);let a=new $o("#ffffff",2.3);a.position.set(.5,-1,2.1);let c=new qo("#ffffff",1.35);r.add(a,c);let l=null,h=0,u=hh(X),f=new P,d={groups:[],of:""},m=new Map,_=[],p=new bh,g=IE(),x=new Le;x.add(g.group,p.group),r.add(x);let b=W=>W.clone().multiplyScalar(x.scale.x).add(x.position),v={width:1,height:1},w=new Zo,E=null,y=[0,0],M=W=>{let et=s.getBoundingClientRect();return new ht(W.clientX-et.left,W.clientY-et.top)},L=W=>{let et=b(W).project(o);return new ht((et.x+1)/2*v.width,(1-et.y)/2*v.height)},R=W=>{if(!l)return null;let et=l.scene.balls[l.ball].position[2];if(w.setFromCamera(new ht(W.x/v.width*2-1,1-W.y/v.height*2),o),Math.abs(w.ray.direction.z)<.03)return null;let ot=w.ray.intersectPlane(new Je(new P(0,0,1),-b(new P(0,0,et)).z),new P);return ot&&ot.sub(x.position).divideScalar(x.scale.x)},D=W=>{if(!l||!g.group.visible)return null;let et=l.scene.balls[l.ball],ot=new P(...et.position),O=new P(1,0,0).applyQuaternion(o.quaternion).multiplyScalar(et.radius),K=Math.max(L(ot).distanceTo(L(ot.clone().add(O))),V_*.7);return L(g.tip).distanceTo(W)<V_?"velocity":L(ot).distanceTo(W)<K?"ball":null};s.addEventListener("pointerdown",W=>{if(W.button!==0||!W.isPrimary||!l)return;let et=M(W),ot=D(et),O=ot&&R(et);if(!ot||!O)return;E=ot,B.enabled=!1,s.setPointerCapture(W.pointerId);let K=ot==="ball"?l.scene.balls[l.ball].position:g.tip.toArray();y=[K[0]-O.x,K[1]-O.y],t?.start()}),s.addEventListener("pointermove",W=>{let et=M(W);if(!E){W.buttons===0&&(s.style.cursor=D(et)?"grab":"");return}let ot=R(et);if(!ot||!l)return;s.style.cursor="grabbing";let[O,K]=[ot.x+y[0],ot.y+y[1]];if(E==="ball")t?.ball(O,K);else{let{position:Tt,radius:ct}=l.scene.balls[l.ball],Rt=Math.hypot(O-Tt[0],K-Tt[1]),St=Math.max(0,Rt-G_*ct)/g.time;t?.velocity(St*(O-Tt[0])/(Rt||1),St*(K-Tt[1])/(Rt||1))}});let N=()=>{E&&(E=null,B.enabled=!0,s.style.cursor="",g.time=l?zr(l):1,z(),t?.end(),u())};s.addEventListener("pointerup",N),s.addEventListener("pointercancel",N);let B=new _h(o,s);B.zoomSpeed=.8,B.maxPolarAngle=Math.PI*.499,B.addEventListener("change",()=>u());let C=null;B.addEventListener("start",()=>C=null);function z(){if(!l)return;let{position:W,velocity:et,radius:ot}=l.scene.balls[l.ball],O=Math.hypot(et[0],et[1]),K=O>0?[et[0]/O,et[1]/O]:[1,0];g.place(W,K,G_*ot+O*g.time,ot,Cn(l.box))}function $(W,et){let ot=!l||l.box!==W.box;l=W,r.background=new Gt(et.background);let O=JSON.stringify([W.scene.walls,!!W.scene.floor,W.box,et,W.scene.balls.map(({radius:K})=>K)]);if(O!==d.of){let K=[PE(W,et),k_(W.scene,W.box,et)];x.add(...K);for(let Tt of d.groups)x.remove(Tt),z_(Tt);d={groups:K,of:O}}G(W.span);for(let{mesh:K}of _)x.remove(K.group);_=[];for(let[K,Tt]of W.runs){let ct=K===W.followed;Tt.balls.forEach(({pieces:Rt},St)=>{if(!ct&&St!==W.ball)return;let Pt=W.colours.get(K)??et.ink,qt=St===W.ball,ee=ct?ji(W.scene.balls[St],St):Pt,xe=ct?qt?Pt:"#2b2f36":et.dark?"#15181d":"#ffffff",jt={ghost:!ct,halo:qt?Pt:null,floor:!!W.scene.floor,dark:et.dark},le=JSON.stringify([K,St,ee,xe,jt]),Qt=m.get(le)??new ch(ee,xe,jt);m.set(le,Qt),Qt.resize(W.scene.balls[St].radius),x.add(Qt.group),_.push({mesh:Qt,turns:new Ui(Rt),law:K,ball:St})})}g.colour(et.ink),p.film(W,et.ink),E||(g.time=zr(W)),z(),ot&&it("free"),st(h)}function G(W){if(!l)return;let{balls:et}=l.scene;p.update({...l,span:W},ot=>ji(et[ot],ot))}function st(W){h=W,u()}function X(){if(!l)return;let W=l.runs.get(l.followed),et=W?Mn(W.balls[l.ball].pieces,h).x:null;for(let{mesh:O,turns:K,law:Tt}of _){let{x:ct,phase:Rt}=Mn(K.pieces,h);if(Rt==="pocketed"){O.group.visible=!1;continue}let St=Tt===l.followed||!et?1/0:Math.hypot(ct[0]-et[0],ct[1]-et[1],ct[2]-et[2]);O.place(ct,K.at(h),St)}p.filmAt(l,h),g.group.visible=t!==null&&!(l.film.length&&h>l.span.from)&&Math.abs(o.getWorldDirection(f).z)>.12,i.render(r,o),Z(et);let ot=[new P(...l.scene.balls[l.ball].position),g.tip].map(O=>L(O).toArray().map(Math.round).join());[s.dataset.ball,s.dataset.arrow]=ot}function Z(W){if(!l)return;let et=o.position.distanceTo(B.target),ot=v.height*x.scale.x/(2*et*Math.tan(o.fov*Math.PI/360)),O=H_(110/ot),K=`${(O*ot).toFixed(1)}px`;e.scale.style.width!==K&&(e.scale.style.width=K,e.scale.textContent=TE(O));let{radius:Tt}=l.scene.balls[l.ball],ct=W&&l.scene.floor?W[2]-Tt:0,Rt=ct>Math.min(2e-5,.002*Tt);if(e.height.hidden=!(W&&Rt),W&&Rt){let St=L(new P(W[0],W[1],W[2]+Tt)),Pt=ct<.1?`${(ct*1e3).toPrecision(2)} mm`:`${ct.toPrecision(3)} m`;e.height.textContent=`${ct<1e-5||ct>=1e3?fp(ct):Pt} up`,e.height.style.transform=`translate(${St.x.toFixed(1)}px, ${(St.y-26).toFixed(1)}px) translateX(-50%)`}}function it(W){if(!l)return;C=W;let{low:et,high:ot}=l.box,O=new P(...Vr(l.box)),K=l.scene.walls.find(le=>le.shape==="plane"&&Math.hypot(le.normal[0],le.normal[1])>.3),Tt=l.runs.get(l.followed)?.events.find(le=>le.kind==="wall"&&le.ball===l?.ball),ct=K?vn([K.normal[0],K.normal[1],0]):W==="along"&&Tt?RE(Tt.impulse):[0,-1,0],Rt=new P(ct[0],ct[1],0),St=new P(-ct[1],ct[0],0),Pt=[];for(let le of[et[0],ot[0]])for(let Qt of[et[1],ot[1]])for(let ke of[et[2],ot[2]])Pt.push(new P(le,Qt,ke));let qt=new P;if(W==="along"){qt.copy(St).multiplyScalar(-1).setZ(.05);let le=l.scene.balls[l.ball].radius;Tt&&l.scene.floor&&(O.set(Tt.x[0],Tt.x[1],1.6*le).addScaledVector(Rt,3*le),Pt=[-5,6].flatMap(Qt=>[-1.4,2].map(ke=>O.clone().addScaledVector(Rt,Qt*le).setZ(O.z+ke*le))))}else W==="side"?qt.copy(Rt).setZ(.05):W==="above"?qt.set(0,-5e-4,1):qt.copy(Rt).multiplyScalar(K?.8:1).addScaledVector(St,K?-.75:.2).setZ(K?.8:1.05);qt.normalize();let ee=Mt(Pt,O,qt),xe=ee>.01&&ee<1e4;x.scale.setScalar(xe?1:1/ee),x.position.set(0,0,0),O.length()>1e3*ee&&x.position.copy(O).multiplyScalar(-x.scale.x),x.updateMatrixWorld(!0);let jt=ee*x.scale.x;o.near=jt/200,o.far=jt*60,o.updateProjectionMatrix(),B.target.copy(b(O)),o.position.copy(B.target).addScaledVector(qt,jt),B.minDistance=jt/40,B.maxDistance=jt*8,B.update(),u()}function Mt(W,et,ot){let O=new P().crossVectors(o.up,ot).normalize(),K=new P().crossVectors(ot,O),Tt=Math.tan(o.fov*Math.PI/360)*.9;return Math.max(...W.map(ct=>{let Rt=ct.clone().sub(et);return Rt.dot(ot)+Math.max(Math.abs(Rt.dot(O))/(Tt*o.aspect),Math.abs(Rt.dot(K))/Tt)}))}function Dt(){let[W,et]=[n.clientWidth,n.clientHeight];!W||!et||(i.setPixelRatio(Math.min(devicePixelRatio,2)),i.setSize(W,et),Object.assign(v,{width:W,height:et}),o.aspect=W/et,o.updateProjectionMatrix(),p.resize(s.width,s.height),C!==null&&it(C),u())}function j(){return X(),new Promise((W,et)=>s.toBlob(ot=>ot?W(ot):et(new Error("The browser gave no picture.")),"image/png"))}return Dt(),{update:$,trace:G,draw:st,look:it,resize:Dt,picture:j}}var RE=([n,t])=>Math.abs(n)>Math.abs(t)?[Math.sign(n),0,0]:[0,Math.sign(t)||-1,0];function PE(n,t){let e=new Le;if(!n.scene.floor)return e;let i=Cn(n.box),[s,r]=Vr(n.box),o=1.6*i,a=new de(new Ts(2*o,2*o),new fn({color:t.floor,polygonOffset:!0,polygonOffsetFactor:2,polygonOffsetUnits:2}));a.position.set(s,r,0),e.add(a);let c=H_(i/6),l=[],[h,u]=[s,r].map(d=>Array.from({length:Math.ceil(2*o/c)},(m,_)=>(Math.ceil((d-o)/c)+_)*c));for(let d of h)d<=s+o&&l.push(d,r-o,0,d,r+o,0);for(let d of u)d<=r+o&&l.push(s-o,d,0,s+o,d,0);let f=new ae;return f.setAttribute("position",new Vt(l,3)),e.add(new _i(f,new Zn({color:t.grid}))),e}function IE(){let n=new fn({color:"#000000"}),t=new de(new Gi(1,1,1,12).rotateX(Math.PI/2).translate(0,0,.5),n),e=new de(new Lo(1,1,20).rotateX(Math.PI/2).translate(0,0,-.5),n),i=new de(new vi(.9,1,48),new fn({color:"#000000",transparent:!0,opacity:.5,depthWrite:!1})),s=new Le;s.add(t,e,i);let r=new P,o=new P(0,0,1);return{group:s,tip:r,time:1,colour(a){n.color.set(a),i.material.color.set(a)},place(a,c,l,h,u){let f=Math.max(.07*h,.0022*u),d=new Ne().setFromUnitVectors(o,new P(c[0],c[1],0));r.set(a[0]+c[0]*l,a[1]+c[1]*l,a[2]);let m=Math.min(6*f,.6*l);t.position.set(...a),t.quaternion.copy(d),t.scale.set(f,f,Math.max(l-m,.001*l)),e.position.copy(r),e.quaternion.copy(d),e.scale.set(2.4*f,2.4*f,m),i.position.set(a[0],a[1],a[2]-h*.99),i.scale.setScalar(h)}}}var X_=0;function ei(n,t=!1){let e=$t("message");e.textContent=n,e.hidden=!n,e.className=t?"good":"bad",clearTimeout(X_),t&&(X_=window.setTimeout(()=>e.hidden=!0,6e3))}var LE=n=>n<=90?n:null;function NE(n,t){return t?`#${[1,3,5].map(i=>parseInt(n.slice(i,i+2),16)).map(i=>Math.round(i+(255-i)*.28).toString(16).padStart(2,"0")).join("")}`:n}function DE(n,t){return n===0?"drop a CSV table anywhere on the page":`${n} from ${t}. The curves are not fitted to them: they are for the restitution, friction and cushion height set by the sliders.`}function UE(){let n=getComputedStyle(document.documentElement),t=e=>n.getPropertyValue(`--${e}`).trim();return{background:t("sky"),floor:t("felt"),grid:t("grid"),wall:t("wall"),edge:t("edge"),ink:t("ink"),soft:t("soft"),dark:document.documentElement.dataset.theme==="dark"}}var $_=n=>JSON.parse($t(n).textContent??"null");async function OE(){if(performance.mark("script"),document.documentElement.dataset.theme=matchMedia("(prefers-color-scheme: dark)").matches?"dark":"light",typeof WebAssembly!="object")throw new Error("This browser has no WebAssembly, in which carom's engine is: any browser since 2018 has it.");let n=$_("page-data"),t=Uint8Array.from(atob(($t("engine-module").textContent??"").trim()),f=>f.charCodeAt(0)),e=$_("engine-layout"),{recorded:i,presets:s}=n,r=await(i?up(t,e,s[0].scene,i):hp(t,e)),o=r,[a,c]=[r.report.bind(r),r.run.bind(r)],l={run:a,pieces:c,version:r.version,...!i&&{shots:r.shots.bind(r)}};Object.assign(window,{carom:l}),i&&(document.documentElement.dataset.recorded="true");let{store:h,at:u}=FE(n,o);Object.assign(l,{scene:()=>structuredClone(h.state.scene),at:u})}function FE(n,t){let e=()=>n.presets.findIndex(({name:O})=>O===new URLSearchParams(location.hash.replace(/^#/,"")).get("preset")),i=Math.max(0,e()),s=n.presets[i],r=O=>({film:O?.film??[],shot:O?.film?O.name:""}),o=[Ni,...n.cards.map(({name:O})=>O)],a=O=>n.recorded?n.cards:kp(n.cards,O),c=O=>a(O.scene).map(({name:K})=>K).filter(K=>O.laws.includes(K)),l=null;try{n.recorded||(l=cu(location.hash,t,o))}catch(O){ei(si(O))}let h=l?.scene??zs(t,s.scene),u=l?.laws??c(s),f=Vs(t,h,u.length?u:[h.run.law]).fault;f!==null&&l&&(ei(`The scene of this link cannot be shown: ${f}`),l=null,h=zs(t,s.scene));let d=new Ja({scene:h,...r(l&&e()<0?void 0:s),laws:l?.laws??c(s),followed:"",ball:0,wall:-1,t:l?.t??s.time??0,playing:!1,span:l?null:s.span??null,speed:s.slow??1,rebounds:n.rebounds,reboundsFrom:n.reboundsFrom,cards:a(h)}),{state:m}=d,_=O=>[O,m.cards[0]?.name===Ni?Ni:void 0,m.scene.run.law].find(K=>K&&m.laws.includes(K))??m.laws[0]??"";m.followed=_(l?.followed);let p=Vs(t,m.scene,m.laws),g=au(m.scene,p.runs.values(),m.span),x=pa(m.scene,p.runs,m.followed,g),b=lu(m.scene,p.runs.get(m.followed)),v=()=>new Map(m.cards.map(({name:O,colour:K})=>[O,NE(K,document.documentElement.dataset.theme==="dark")])),w=$t("stage"),E=n.recorded?null:{start:()=>d.remember(),ball:(O,K)=>G(bn(m.scene,m.ball,{position:[O,K,m.scene.balls[m.ball].position[2]]})),velocity:(O,K)=>G(bn(m.scene,m.ball,{velocity:[O,K,m.scene.balls[m.ball].velocity[2]]})),end:()=>{}},y,M=!!document.createElement("canvas").getContext("webgl2");M?y=W_(w,E,{scale:$t("scale"),height:$t("height")}):(y=C_(w,E),$t("scale").hidden=!0,ei("This browser has no WebGL 2: the scene is drawn from above and from the side."));let L=w.querySelector("canvas"),R=w.querySelector(".views");for(let{name:O,label:K}of M?w_:[])R.append(Kt("button",{type:"button","data-view":O,click:()=>{x=pa(m.scene,p.runs,m.followed,g),it(new Set(["scene"])),y.look(O)}},K));let D=$(),N=Up($t("controls"),d,G,ei,eg(n.presets)),B=Jm($t("angles")),C=ig(d,()=>({...g,events:b})),z=jm($t("course"),C.seek);Vp(d,y,()=>p.runs.get(m.followed),ei);function $(){return $t("laws").replaceChildren(Kt("h2",{},"Laws")),{cards:m.cards,panel:Op($t("laws"),d)}}function G(O){let K=Vs(t,O,m.laws.length?m.laws:[O.run.law]);if(K.fault!==null){ei(K.fault),N.update();return}ei(""),d.change({scene:O,span:null},"scene")}let st=new Set,X=!1;d.listen(O=>{(O.has("scene")||O.has("laws"))&&(m.cards=a(m.scene),m.laws=m.cards.map(({name:K})=>K).filter(K=>m.laws.includes(K)),m.followed=_(m.followed),p=Vs(t,m.scene,m.laws),g=au(m.scene,p.runs.values(),m.span),b=lu(m.scene,p.runs.get(m.followed)),m.t=Math.max(g.from,Math.min(m.t,g.until))),st=new Set([...st,...O]),X||requestAnimationFrame(()=>it(st)),X=!0});function Z(){let O=ag(p.runs.get(m.followed),g);return O===1/0?g:{from:Math.max(g.from,m.t-O),until:m.t}}function it(O){X=!1,st=new Set;let K=v();if(O.has("scene")||O.has("laws")){y.update({scene:m.scene,ball:m.ball,followed:m.followed,runs:p.runs,colours:K,span:Z(),box:x,film:m.film},UE()),$t("key").hidden=!m.scene.floor,$t("apart").hidden=$t("key-film").hidden=!m.film.length,L.setAttribute("aria-label",`The scene: ${m.scene.balls.length} ball${m.scene.balls.length>1?"s":""} under ${m.laws.join(", ")||"no law"}. Drag the ball or its arrow, or use the sliders.`);let Tt=ou(t,m.scene,m.cards);D.cards.length!==m.cards.length&&Object.assign(D,$()),D.panel.update(Tt.verdicts,K,p.notes,Tt.note),N.update(),Dt(Tt,K),j(K)}else O.has("data")?Dt(ou(t,m.scene,m.cards),K):Z()!==g&&y.trace(Z());y.draw(m.t),z.place(m.t),C.update(),$t("apart").textContent=Mt()}function Mt(){let O=p.runs.get(m.followed);return`From film to run: ${m.film.map((Tt,ct)=>{let Rt=O&&Fu(Tt,O.balls[ct].pieces,m.t);return`${ii(m.scene,ct)}: ${Rt==null?"not seen":`${(1e3*Rt).toFixed(1)} mm`}`}).join(", ")}`}function Dt({meeting:O,verdicts:K},Tt){let ct=m.cards.filter(({name:St})=>m.laws.includes(St)),Rt=Bp(t,O,ct.map(({name:St})=>St));B.update(ct.map(({name:St,dashes:Pt})=>({name:St,colour:Tt.get(St)??"#888",dashes:Pt,width:St===m.followed?2.4:1.6,points:Rt.get(St)??[]})),m.rebounds,O&&LE(t.incidenceAt(O)),ct.flatMap(({name:St})=>{let Pt=K.get(St)?.angle;return typeof Pt=="number"?[{colour:Tt.get(St)??"#888",y:Pt}]:[]}),O||n.recorded?"":`${ii(m.scene,0)} meets no wall`),$t("measured").textContent=DE(m.rebounds.length,m.reboundsFrom)}function j(O){let K=[],Tt=[];for(let{name:St,dashes:Pt}of m.cards){let qt=p.runs.get(St);if(!qt)continue;let ee={name:St,colour:O.get(St)??"#888",dashes:Pt,width:St===m.followed?2.2:1.5},xe=lg(qt,m.ball,g,60),jt=Za(m.scene,qt,0),le=m.scene.floor?m.scene.balls[m.ball].radius:0;jt>0&&K.push({...ee,points:xe.map(Qt=>[Qt,Za(m.scene,qt,Qt)/jt])}),Tt.push({...ee,points:xe.map(Qt=>[Qt,(Mn(qt.balls[m.ball].pieces,Qt).x[2]-le)*1e3])})}let ct=p.runs.get(m.followed),Rt=m.film.map((St,Pt)=>{let qt=(Pt===m.ball?O.get(m.followed):null)??ji(m.scene.balls[Pt],Pt);return{name:String(Pt),colour:qt,dashes:null,width:1.5,points:ct?cg(St,ct.balls[Pt].pieces,g):[]}});z.update(K,Rt.length?Rt:Tt,g,Rt.length?"from film to run":"height")}let W=$t("preset");W.append(...n.presets.map(({title:O},K)=>Kt("option",{value:String(K)},O))),W.value=String(i);let et=O=>$t("about").textContent=O;et(l?"":s.about),W.onchange=()=>{let O=n.presets[Number(W.value)];d.remember(),ei(""),et(O.about),Object.assign(m,{...r(O),ball:0,wall:-1,t:O.time??0,span:O.span??null,speed:O.slow??1,playing:!1}),d.change({scene:zs(t,O.scene),laws:c(O),followed:O.scene.run.law},"scene","laws","time"),x=pa(m.scene,p.runs,m.followed,g),it(new Set(["scene"])),y.look(O.view??"free")},$t("undo").onclick=()=>d.undo(),$t("redo").onclick=()=>d.redo(),$t("theme").onclick=()=>{let O=document.documentElement;O.dataset.theme=O.dataset.theme==="dark"?"light":"dark",it(new Set(["scene"]))},addEventListener("keydown",O=>{!(O.ctrlKey||O.metaKey)||O.key.toLowerCase()!=="z"||(O.preventDefault(),O.shiftKey?d.redo():d.undo())}),addEventListener("hashchange",()=>{try{let O=n.recorded?null:cu(location.hash,t,o);if(!O)return;let K=Vs(t,O.scene,O.laws.length?O.laws:[O.scene.run.law]).fault;if(K!==null)throw new Error(K);d.remember(),d.change({...O,...r(n.presets[e()]),ball:0,wall:-1,span:null,playing:!1},"scene","laws","time"),x=pa(m.scene,p.runs,m.followed,g),it(new Set(["scene"]))}catch(O){ei(si(O))}}),new ResizeObserver(()=>{y.resize(),it(new Set(["scene"]))}).observe(w),it(new Set(["scene"])),y.look(l?"free":s.view??"free"),performance.mark("ready"),document.documentElement.dataset.ready="true";function ot(O){kd(O);let K=p.runs.get(m.followed);return K?{energy:Za(m.scene,K,O),balls:K.balls.map(({pieces:Tt})=>({...Mn(Tt,O),q:new Ui(Tt).at(O)}))}:null}return{store:d,at:ot}}OE().catch(n=>{ei(si(n)),document.documentElement.dataset.ready="failed"});})();
